//! Tests of the command line.

mod commands;
mod show;
mod sweep;
