//! Tests of the command line.

#[path = "../support/mod.rs"]
mod support;

mod commands;
mod show;
mod sweep;
mod tree_file;
mod tune;
mod verify;
