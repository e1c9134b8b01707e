//! Builds again when a file of the library is added: `include_dir!` only notices changed ones.

#![allow(clippy::print_stdout, reason = "that is how cargo is told")]

fn main() {
    println!("cargo::rerun-if-changed=../../robots");
    println!("cargo::rerun-if-changed=../../materials");
}
