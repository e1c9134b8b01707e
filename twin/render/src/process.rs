//! Drawing in a process of its own, so that a crash or a hang of a driver costs pictures and nothing else.
//!
//! The parent writes a task, the child answers with a picture. Where the child dies or takes too long, rays draw
//! instead: no driver has a part in those, so they are cast in the parent.

mod message;
#[cfg(test)]
mod tests;
mod wire;

use crate::task::Task;
use crate::{Backend, DrawnBy, Engine, Picture, RenderError, gpu};
use std::ffi::OsString;
use std::io::{self, Read, Write};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// A program that calls [`serve`] on its standard input and output when it is started like this.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Drawer {
    /// The program.
    pub program: PathBuf,
    /// What stands behind it on the command line.
    pub args: Vec<OsString>,
    /// One picture may take this long.
    pub patience: Duration,
}

/// Where pictures are drawn. Opens card or child when the first is asked for, and keeps it.
pub struct Studio {
    backend: Backend,
    drawer: Option<Drawer>,
    helper: Option<Helper>,
    engine: Option<Engine>,
    /// Why the card is not asked any more.
    because: Option<String>,
}

impl Studio {
    /// Draws in this process, or where a drawer is given in one of its own.
    pub fn new(backend: Backend, drawer: Option<Drawer>) -> Studio {
        Studio { backend, drawer, helper: None, engine: None, because: None }
    }

    /// Draws a task.
    ///
    /// # Errors
    /// As [`RenderError`] says. With [`Backend::Auto`] a card that fails, hangs or takes its process with it is answered by rays.
    pub fn draw(&mut self, task: &Task) -> Result<Picture, RenderError> {
        let drawn = self.draw_once(task);
        let picture = match drawn {
            Err(e) if self.backend == Backend::Auto && e.is_of_the_card() => {
                self.backend = Backend::Cpu;
                self.because = Some(e.to_string());
                self.engine = None;
                self.draw_once(task)
            }
            drawn => drawn,
        };
        picture.map(|picture| match (&self.because, &picture.drawn_by) {
            (Some(why), DrawnBy::Cpu { because: None }) => {
                Picture { drawn_by: DrawnBy::Cpu { because: Some(why.clone()) }, ..picture }
            }
            _ => picture,
        })
    }

    fn draw_once(&mut self, task: &Task) -> Result<Picture, RenderError> {
        let drawer = self.drawer.clone().filter(|_| self.backend != Backend::Cpu);
        let Some(drawer) = drawer else { return self.draw_here(task) };
        let helper = match self.helper.take() {
            Some(helper) => helper,
            None => Helper::start(&drawer)?,
        };
        let (helper, drawn) = helper.draw(task, self.backend, drawer.patience)?;
        self.helper = Some(helper);
        drawn
    }

    fn draw_here(&mut self, task: &Task) -> Result<Picture, RenderError> {
        if self.engine.is_none() {
            self.engine = Some(open(self.backend)?);
        }
        let engine = self.engine.as_ref().expect("just opened");
        gpu::guarded(|| task.with(engine))
    }
}

/// The machine that is asked for; rays where any will do and no card opens.
pub(crate) fn open(backend: Backend) -> Result<Engine, RenderError> {
    let by_card = || gpu::guarded(|| Ok(Engine::Gpu(Box::new(gpu::Gpu::open()?))));
    match backend {
        Backend::Cpu => Ok(Engine::Cpu { because: None }),
        Backend::Gpu => by_card(),
        Backend::Auto => {
            Ok(by_card().unwrap_or_else(|error| Engine::Cpu { because: Some(error.to_string()) }))
        }
    }
}

/// Answers tasks until the input ends. What the child of a [`Studio`] runs.
///
/// # Errors
/// Input that is not ours, or a parent that has gone.
pub fn serve(mut input: impl Read, mut output: impl Write) -> io::Result<()> {
    let mut studio: Option<(Backend, Studio)> = None;
    while let Some(bytes) = message::read(&mut input)? {
        let Some((backend, task)) = message::task(&bytes) else {
            return Err(io::Error::new(io::ErrorKind::InvalidData, "this is not a task"));
        };
        if studio.as_ref().is_none_or(|(of, _)| *of != backend) {
            studio = Some((backend, Studio::new(backend, None)));
        }
        let (_, studio) = studio.as_mut().expect("just made");
        message::write(&mut output, &message::answer(&studio.draw(&task)))?;
    }
    Ok(())
}

/// A running child. Both ends of the talk are on threads of their own: a child that hangs must not hang us.
struct Helper {
    child: Child,
    tasks: Sender<Vec<u8>>,
    answers: Receiver<io::Result<Option<Vec<u8>>>>,
}

impl Helper {
    fn start(drawer: &Drawer) -> Result<Helper, RenderError> {
        let mut child = Command::new(&drawer.program)
            .args(&drawer.args)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|e| RenderError::Process(format!("it cannot be started: {e}")))?;
        let (Some(mut stdin), Some(mut stdout)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(RenderError::Process("it has no pipes".into()));
        };
        let (tasks, to_write) = channel::<Vec<u8>>();
        std::thread::spawn(move || {
            // ends with the sender, or with the child
            while let Ok(task) = to_write.recv() {
                if message::write(&mut stdin, &task).is_err() {
                    break;
                }
            }
        });
        let (answered, answers) = channel();
        std::thread::spawn(move || {
            loop {
                let answer = message::read(&mut stdout);
                let last = !matches!(answer, Ok(Some(_)));
                if answered.send(answer).is_err() || last {
                    break;
                }
            }
        });
        Ok(Helper { child, tasks, answers })
    }

    /// The picture, and the child to ask again; an error where the child is lost.
    fn draw(
        mut self,
        task: &Task,
        backend: Backend,
        patience: Duration,
    ) -> Result<(Helper, Result<Picture, RenderError>), RenderError> {
        let lost = |helper: &mut Helper, why: String| {
            let _ = helper.child.kill();
            let ended = helper.child.wait().map_or(String::new(), |status| status.to_string());
            RenderError::Process(if why.is_empty() { ended } else { why })
        };
        if self.tasks.send(message::asked(backend, task)).is_err() {
            return Err(lost(&mut self, String::new()));
        }
        match self.answers.recv_timeout(patience) {
            Ok(Ok(Some(bytes))) => match message::answered(&bytes) {
                Some(drawn) => Ok((self, drawn)),
                None => Err(lost(&mut self, "its answer cannot be read".into())),
            },
            Err(RecvTimeoutError::Timeout) => {
                let why = format!("it took longer than {:.0} s", patience.as_secs_f64());
                Err(lost(&mut self, why))
            }
            // the pipe is closed: the child is dead or about to die by itself
            Ok(_) | Err(RecvTimeoutError::Disconnected) => {
                let ended = self.child.wait().map_or(String::new(), |status| status.to_string());
                Err(RenderError::Process(ended))
            }
        }
    }
}

impl Drop for Helper {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
