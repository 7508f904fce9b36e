//! Tests of the window.

mod harness;
#[path = "../support/mod.rs"]
mod support;

mod accuracy;
mod build;
mod compare;
mod feel;
mod formats;
mod heat;
mod judge;
mod keep;
mod lesson;
mod model;
mod painted;
mod paper;
mod process;
mod rays;
mod settings;
mod sweep;
mod tree;
mod tune;
mod window;
