//! Tests of the window.

mod harness;
#[path = "../support/mod.rs"]
mod support;

mod acceptance;
mod accuracy;
mod boxes;
mod build;
mod compare;
mod contrast;
mod explore;
mod feel;
mod first_start;
mod formats;
mod heat;
mod judge;
mod keep;
mod lesson;
mod measures;
mod model;
mod painted;
mod paper;
mod present;
mod process;
mod rays;
mod settings;
mod snapshots;
mod sweep;
mod theme;
mod tree;
mod tree_file;
mod tune;
mod twelve;
mod view3d;
mod window;
