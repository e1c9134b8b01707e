//! `twin draw`: the process that draws for another `twin`. Not for people.

use std::io;

use crate::FEASIBLE;
use crate::refusal::Failure;

/// Draw pictures for the program that started this one
#[derive(Debug, clap::Args)]
#[command(hide = true)]
pub(crate) struct Draw {}

impl Draw {
    pub(crate) fn run(self) -> Result<u8, Failure> {
        // the parent has the terminal's streams; ours are its pipes
        render::serve(io::stdin().lock(), io::stdout().lock()).map_err(Failure::Output)?;
        Ok(FEASIBLE)
    }
}
