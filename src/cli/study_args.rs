//! The raw arguments of `bspscope study`.

use super::setting_args::{SettingArgs, Studied};
use super::values::study_writer_names;
use clap::{Args, Subcommand, value_parser};
use std::path::PathBuf;

/// Answer questions by measuring many structures
#[derive(Debug, Args)]
pub struct StudyArgs {
    #[command(subcommand)]
    pub command: StudyCommand,
}

#[derive(Debug, Subcommand)]
pub enum StudyCommand {
    Measures(MeasuresArgs),
}

/// Find which measure predicts time
///
/// Traces primary, shadow, reflected and random rays in over a hundred structures of each scene: all build methods
/// with several depths and leaf sizes, and hierarchies of widths 2, 4 and 8, with every kernel. Says how much of the
/// times each measure explains, with 95 % confidence intervals, and how well it predicts structures that were left out
/// of the fit: SAH cost, SAH cost with end-point overlap, counts of nodes and tests, bytes, and equation (1).
///
/// Takes minutes per scene. Run it on a machine that does nothing else.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  bspscope study measures balls\n  \
    bspscope study measures balls terrain --rays 1024 --rounds 3 --format csv -o measures.csv\n  \
    bspscope study measures -o docs/which-measure.md --figures docs/which-measure")]
pub struct MeasuresArgs {
    /// Scene files or generators [default: the six scenes of the paper, lattice and terrain]
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
    #[command(flatten)]
    pub settings: SettingArgs<Studied>,
    /// Rays per set
    #[arg(long, value_name = "N", default_value_t = 4096, value_parser = value_parser!(u32).range(1..=1_000_000))]
    pub rays: u32,
    /// How often to time each structure; the median is used
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// Output format [default: by the extension of -o, or text]
    #[arg(long, value_name = "FORM", value_parser = study_writer_names(), help_heading = "Output")]
    pub format: Option<String>,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
    /// Also draw a figure per scene (.svg) into this folder, to which a document refers
    #[arg(long, value_name = "FOLDER", help_heading = "Output")]
    pub figures: Option<PathBuf>,
}
