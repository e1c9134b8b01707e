use super::message::{answer, answered, asked, read, task, write};
use super::*;
use crate::view::{Camera, Fit, View};
use crate::{RenderError, tests::scene};
use proptest::prelude::*;
use sim::scene::{Bounds, Row};

fn tasks() -> Vec<Task> {
    let bounds = Bounds::of([[0.0; 3].into(), [1.0, 2.0, 3.0].into()]).expect("two points");
    let row = Row {
        title: "a row".into(),
        scenes: vec![scene(), scene()],
        notes: vec!["one\u{a0}note".into()],
        stamp: Some("illustration".into()),
    };
    let mut all = vec![
        Task::Sheet { scene: Box::new(scene()), size_px: (640, 400) },
        Task::CloseUp { scene: Box::new(scene()), size_px: (320, 240) },
        Task::Row { row: Box::new(row), size_px: (640, 480) },
    ];
    let turned = Camera::Orbit { azimuth_deg: 12.5, elevation_deg: -3.0 };
    for (camera, fit) in
        [(Camera::Top, Fit::Cell), (turned, Fit::Part), (Camera::Side, Fit::Box(bounds))]
    {
        let view = View { size_px: (320, 240), camera, fit, ghost_arm: fit == Fit::Part };
        all.push(Task::View { scene: Box::new(scene()), view });
    }
    all
}

#[test]
fn tasks_arrive_as_they_were_sent() {
    for sent in tasks() {
        let (backend, back) = task(&asked(Backend::Gpu, &sent)).expect("our own bytes");
        assert_eq!(backend, Backend::Gpu);
        assert_eq!(format!("{back:?}"), format!("{sent:?}"));
    }
}

#[test]
fn a_talk_over_pipes_draws_the_same_picture() {
    let all = tasks();
    let mut input = Vec::new();
    for sent in &all {
        write(&mut input, &asked(Backend::Cpu, sent)).expect("memory");
    }
    // what a test harness or a driver prints before does no harm
    let mut output = b"running 1 test\n".to_vec();
    serve(&input[..], &mut output).expect("served");
    let mut output = &output[..];
    let mut here = Studio::new(Backend::Cpu, None);
    for sent in &all {
        let bytes = read(&mut output).expect("framed").expect("an answer");
        let there = answered(&bytes).expect("our own bytes").expect("drawn");
        let want = here.draw(sent).expect("drawn");
        assert!(there.rgba == want.rgba, "{sent:?}");
        assert_eq!((there.views, there.drawn_by), (want.views, want.drawn_by));
    }
    assert!(matches!(read(&mut output), Ok(None)));
}

#[test]
fn errors_arrive_too() {
    for error in [
        RenderError::NoAdapter("none".into()),
        RenderError::Gpu("lost".into()),
        RenderError::Size { width: 3, height: 70_000 },
        RenderError::Font,
        RenderError::Process("killed".into()),
    ] {
        let back = answered(&answer(&Err(error.clone()))).expect("our own bytes");
        assert_eq!(back.err(), Some(error));
    }
}

#[test]
fn half_a_message_is_an_error_and_not_a_picture() {
    let mut framed = Vec::new();
    write(&mut framed, &asked(Backend::Cpu, &tasks()[0])).expect("memory");
    assert!(serve(&framed[..framed.len() / 2], Vec::new()).is_err());
    framed[8] = 0xFF;
    framed[15] = 0xFF;
    assert!(serve(&framed[..], Vec::new()).is_err());
    assert!(serve(&[0_u8; 100_000][..], Vec::new()).is_err(), "only noise");
}

/// A program that is not one of ours, one that hangs, and one that is not there.
#[test]
fn a_lost_process_costs_a_picture_at_most() {
    let task = &tasks()[1];
    let drawer = |program: &str, args: &[&str]| Drawer {
        program: program.into(),
        args: args.iter().map(Into::into).collect(),
        patience: Duration::from_millis(300),
    };
    for drawer in [
        drawer("/bin/true", &[]),
        drawer("/bin/sh", &["-c", "kill -ABRT $$"]),
        drawer("/bin/sleep", &["60"]),
        drawer("/nonexistent/twin", &["draw"]),
    ] {
        let lost = Studio::new(Backend::Gpu, Some(drawer.clone())).draw(task);
        assert!(matches!(lost, Err(RenderError::Process(_))), "{drawer:?}");
        let drawn = Studio::new(Backend::Auto, Some(drawer.clone())).draw(task).expect("by rays");
        let said = drawn.drawn_by.to_string();
        assert!(said.contains("the process that draws was lost"), "{drawer:?}: {said}");
        assert!(drawn.rgba == Studio::new(Backend::Cpu, None).draw(task).expect("drawn").rgba);
    }
}

proptest! {
    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = (task(&bytes), answered(&bytes));
    }

    /// Damage inside a real task.
    #[test]
    fn damaged_tasks_are_read_or_refused(at in 0_usize..4000, value: u8, cut in 0_usize..4000) {
        let mut bytes = asked(Backend::Cpu, &tasks()[0]);
        let n = bytes.len();
        bytes[at % n] = value;
        bytes.truncate(n - cut % n);
        let _ = task(&bytes);
    }
}
