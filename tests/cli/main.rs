//! Tests of the command line.

#[path = "../support/mod.rs"]
mod support;

#[cfg(unix)]
mod cluster;
mod commands;
mod show;
mod sweep;
mod tune;
mod verify;
