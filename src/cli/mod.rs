//! The command line: raw arguments ([`args`]), what they resolve to ([`resolve`]), one file per
//! command.
//!
//! Exit codes: 0 done, 1 a check failed, 2 invalid use or input.

mod accuracy;
mod args;
mod bar;
mod check;
mod compare;
mod failures;
mod generate;
mod heat;
mod leaves;
mod lesson;
mod measure;
mod merge;
mod methods;
mod model;
mod outcome;
mod output;
mod paper;
mod picture;
mod probe;
mod render;
mod report;
mod resolve;
mod setting_args;
mod stability;
mod study;
mod study_args;
mod sweep;
mod tree;
mod tune;
mod values;
mod verify;
mod verify_exact;
mod window;

use args::{Arguments, Command};
use clap::Parser;
use outcome::Outcome;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let outcome = match &arguments.command {
        None => window::run(&arguments.window),
        Some(Command::Window(args)) => window::run(args),
        Some(Command::Measure(args)) => measure::run(args),
        Some(Command::Merge(args)) => merge::run(args),
        Some(Command::Sweep(args)) => sweep::run(args),
        Some(Command::Model(args)) => model::run(args),
        Some(Command::Check(args)) => check::run(args),
        Some(Command::Compare(args)) => compare::run(args),
        Some(Command::Leaves(args)) => leaves::run(args),
        Some(Command::Tree(args)) => tree::run(args),
        Some(Command::Report(args)) => report::run(args),
        Some(Command::Render(args)) => render::run(args),
        Some(Command::Paper(args)) => paper::run(args),
        Some(Command::Probe(args)) => probe::run(args),
        Some(Command::Generate(args)) => generate::run(args),
        Some(Command::Methods(args)) => methods::run(args),
        Some(Command::Verify(args)) => verify::run(args),
        Some(Command::Stability(args)) => stability::run(args),
        Some(Command::Accuracy(args)) => accuracy::run(args),
        Some(Command::Lesson(args)) => lesson::run(args),
        Some(Command::Tune(args)) => tune::run(args),
        Some(Command::Study(args)) => study::run(args),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::CheckFailed) => ExitCode::from(1),
        // The reader closed the pipe, as in `bspscope … | head`.
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            // If standard error is closed, only the exit code remains.
            let _ = writeln!(std::io::stderr(), "bspscope: {error:#}");
            ExitCode::from(2)
        }
    }
}

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .downcast_ref::<std::io::Error>()
        .is_some_and(|e| e.kind() == ErrorKind::BrokenPipe)
}
