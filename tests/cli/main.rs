//! Tests of the command line.

#[path = "../support/mod.rs"]
mod support;

#[cfg(unix)]
mod cluster;
mod commands;
mod show;
mod study;
mod sweep;
mod tree_file;
mod tune;
mod verify;
