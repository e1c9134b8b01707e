//! `twin validate`: the laws against what others measured.

use sim::process::Material;
use sim::validation::{self, Case, Kind, Sides, Verdict};
use slam::{Source, Span};

use crate::library::{Library, LibraryArgs};
use crate::load::{self, Naming};
use crate::refusal::{Failure, Refusal};
use crate::screen::Screen;
use crate::{FEASIBLE, FOUND};

/// The cell whose limit a frame is held against.
const CELL: &str = "kr6-hot-end";
/// The cell whose lamps set a gel.
const LAMPS: &str = "kirkman-sda10d";
/// Indent of what belongs to a case.
const INDENT: usize = 4;

/// Hold the laws of the process against published numbers
///
/// Prints source, theirs, ours and verdict of every published, paper and practice case, computed with the
/// materials of the library. Exits with 0 if all are inside or say why not, else with 1.
#[derive(Debug, clap::Args)]
pub(crate) struct Validate {
    /// Only the case of this id, such as PRICCI-TRENDS
    #[arg(value_name = "ID")]
    id: Option<String>,
    #[command(flatten)]
    library: LibraryArgs,
}

impl Validate {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let library = Library::open(&self.library)?;
        // named by nobody's file: the program itself asks for them
        let program = Source::new("library", "");
        let naming = Naming { source: &program, span: Span::default(), folder: None };
        let material = |name: &str| material(name, &naming, &library);
        let cell = |name: &str| cell(name, &naming, &library);
        let (abs, pla) = (material("abs")?, material("pla")?);
        let (pla_carbon, resin) = (material("pla-carbon")?, material("sla-resin-silica")?);
        let two_part = material("two-part-acrylic")?;
        let cases = validation::cases(&validation::Library {
            abs: &abs,
            pla: &pla,
            pla_carbon: &pla_carbon,
            resin: &resin,
            two_part: &two_part,
            ring: cell(LAMPS)?.tool.light_ring,
            deflection_m: cell(CELL)?.limits.deflection_m,
        });
        let exact = validation::exact_cases();
        match self.id {
            Some(id) => one(&id, cases.iter().chain(&exact), screen),
            None => all(&cases, &exact, screen),
        }
    }
}

fn one<'a>(
    id: &str,
    cases: impl Iterator<Item = &'a Case>,
    screen: &mut Screen<'_>,
) -> Result<u8, Failure> {
    let cases: Vec<&Case> = cases.collect();
    let Some(case) = cases.iter().find(|case| case.id.eq_ignore_ascii_case(id.trim())) else {
        let known: Vec<String> = cases.iter().map(|case| case.id.to_owned()).collect();
        let message = format!("there is no case `{}`", crate::names::clipped(id));
        let problem = slam::Diagnostic::error(Span::default(), message);
        let problem = crate::names::with_names(problem, id, &known);
        return Err(Refusal::of(&Source::new("ID", id), vec![problem]).into());
    };
    tell(case, screen)?;
    Ok(if case.is_explained() { FEASIBLE } else { FOUND })
}

fn all(cases: &[Case], exact: &[Case], screen: &mut Screen<'_>) -> Result<u8, Failure> {
    for case in cases {
        tell(case, screen)?;
    }
    for kind in [Kind::Published, Kind::Paper, Kind::Practice, Kind::Reference] {
        count(kind_word(kind), cases.iter().filter(|case| case.kind == kind), screen)?;
    }
    count("closed form", exact.iter(), screen)?;
    let rest =
        "the closed forms that take more than a call are tests of `sim::process`, by their ids";
    writeln!(screen.out, "{:12}   {rest}", "")?;
    let unexplained: Vec<&str> =
        cases.iter().chain(exact).filter(|case| !case.is_explained()).map(|case| case.id).collect();
    if unexplained.is_empty() {
        writeln!(screen.out, "\nall are inside, or say why not")?;
        return Ok(FEASIBLE);
    }
    writeln!(screen.out, "\nnobody knows why: {}", unexplained.join(", "))?;
    Ok(FOUND)
}

/// One line: how many of a kind came to what.
fn count<'a>(
    kind: &str,
    cases: impl Iterator<Item = &'a Case>,
    screen: &mut Screen<'_>,
) -> Result<(), Failure> {
    let (mut inside, mut outside, mut neither) = (0, 0, 0);
    for case in cases {
        match case.verdict() {
            Verdict::Inside => inside += 1,
            Verdict::Outside(_) => outside += 1,
            Verdict::NotComparable(_) => neither += 1,
        }
    }
    writeln!(
        screen.out,
        "{kind:<12}{inside:>3} inside, {outside} outside, {neither} not comparable"
    )?;
    Ok(())
}

fn tell(case: &Case, screen: &mut Screen<'_>) -> Result<(), Failure> {
    let width = screen.width();
    let (word, why) = match case.verdict() {
        Verdict::Inside => ("inside", String::new()),
        Verdict::Outside(why) => ("OUTSIDE", why),
        Verdict::NotComparable(_) => ("not comparable", String::new()),
    };
    writeln!(screen.out, "{}  {word}  {}", case.id, case.title)?;
    let source = format!("{}: {}", kind_word(case.kind), case.source);
    paragraph("source", &source, width, screen)?;
    let longest =
        case.checks.iter().map(|check| check.what.chars().count()).max().unwrap_or(0).min(44);
    for check in &case.checks {
        let mark = if check.holds() == Some(false) { "  <- outside" } else { "" };
        let what = &check.what;
        writeln!(
            screen.out,
            "{:INDENT$}{what:<longest$}  theirs {}  ours {}{mark}",
            "",
            check.theirs(),
            check.ours()
        )?;
        if let Sides::Missing { why, .. } = &check.sides {
            paragraph("", why, width, screen)?;
        }
    }
    if word == "OUTSIDE" {
        let why = if why.is_empty() { "nobody knows why" } else { why.as_str() };
        paragraph("why", why, width, screen)?;
    }
    paragraph("note", &case.note, width, screen)?;
    writeln!(screen.out)?;
    Ok(())
}

/// A text under its label, broken between words; nothing for an empty text.
fn paragraph(
    label: &str,
    text: &str,
    width: usize,
    screen: &mut Screen<'_>,
) -> Result<(), Failure> {
    const LABEL: usize = 8;
    let mut row = String::new();
    let mut rows = Vec::new();
    for word in text.split_whitespace() {
        if !row.is_empty()
            && row.chars().count() + 1 + word.chars().count() > width - INDENT - LABEL
        {
            rows.push(std::mem::take(&mut row));
        }
        if !row.is_empty() {
            row.push(' ');
        }
        row.push_str(word);
    }
    if !row.is_empty() {
        rows.push(row);
    }
    for (i, row) in rows.iter().enumerate() {
        let label = if i == 0 { label } else { "" };
        writeln!(screen.out, "{:INDENT$}{label:<LABEL$}{row}", "")?;
    }
    Ok(())
}

fn kind_word(kind: Kind) -> &'static str {
    match kind {
        Kind::Published => "published",
        Kind::Paper => "paper",
        Kind::Practice => "practice",
        Kind::Reference => "reference",
        Kind::Exact => "closed form",
    }
}

fn material(name: &str, naming: &Naming<'_>, library: &Library) -> Result<Material, Refusal> {
    let (file, _) = load::material(name, naming, library)?;
    Ok(sim::cell::material(&file))
}

fn cell(name: &str, naming: &Naming<'_>, library: &Library) -> Result<sim::cell::Cell, Refusal> {
    let parts = load::cell_parts(name, naming, library)?;
    let (material, _) = load::material("pla", naming, library)?;
    load::bare_machine(&parts, &material).map_err(|fault| Refusal::whole(name, fault))
}
