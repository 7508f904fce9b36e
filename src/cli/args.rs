//! The raw arguments. Options for settings are generated from the list of settings
//! ([`super::setting_args`]).

use super::setting_args::{
    Answered, Built, Everything, Extreme, Loaded, Modelled, OneMethod, Reference, Reproduced,
    SettingArgs, Shared, Swept, Tuned, Verified,
};
use super::study_args::StudyArgs;
use super::values::{
    ByColormap, ByHeatmap, ByParameter, colormap_names, equation_names, filter_names, goal_names,
    heatmap_names, knob_names, leaf_writer_names, mebibytes, method_names, paper_scenes,
    parameter_names, pixel, precision_names, range, scale_names, seconds, share, writer_names,
};
use crate::measure::accuracy::Knob;
use crate::measure::heat::RayFilter;
use crate::measure::model::Equation;
use crate::measure::paper::PaperScene;
use crate::measure::sweep::Shard;
use crate::measure::tune::Goal;
use crate::present::overlay::{Range, Scale};
use crate::primitive::Precision;
use crate::scene::builtin::BUILTINS;
use crate::scene::format::FORMATS;
use crate::setup::Edits;
use crate::structure::Method;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use std::time::Duration;

/// Show, measure and compare the acceleration structures that make ray tracing fast
///
/// Without a command, opens the window. Without a display, measures the scene with both methods of
/// the paper and prints the result.
#[derive(Debug, Parser)]
#[command(
    name = "bspscope",
    version,
    args_conflicts_with_subcommands = true,
    after_help = help("bspscope balls\nbspscope rings.bspscope\nbspscope measure scenes/rings.nff --cylinders polygons:10\n\
        bspscope render teaching -o teaching.png")
)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    #[command(flatten)]
    pub window: WindowArgs,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    Window(WindowArgs),
    Measure(MeasureArgs),
    Merge(MergeArgs),
    Model(ModelArgs),
    Compare(CompareArgs),
    Check(CheckArgs),
    Paper(PaperArgs),
    Render(RenderArgs),
    Report(PageArgs),
    Leaves(LeavesArgs),
    Tree(TreeArgs),
    Sweep(SweepArgs),
    Probe(ProbeArgs),
    Generate(GenerateArgs),
    Methods(MethodsArgs),
    Verify(VerifyArgs),
    Stability(StabilityArgs),
    #[command(alias = "trade")]
    Accuracy(AccuracyArgs),
    Lesson(LessonArgs),
    Tune(TuneArgs),
    Study(StudyArgs),
}

/// Open the window (the default command)
#[derive(Debug, Args)]
pub struct WindowArgs {
    /// What to open: a scene file, a generator with an optional size (NAME or NAME:SIZE), or a
    /// workspace (.bspscope) [default: continue the last session]
    pub scene: Option<String>,
    /// Open a lesson: a name (see 'bspscope lesson list') or a file
    #[arg(long, value_name = "LESSON")]
    pub lesson: Option<String>,
    #[command(flatten)]
    pub settings: SettingArgs<Everything>,
    /// Without a display: also write the picture to this file (.png)
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

/// Measure every parameter of the paper, with Δ and Λ listed separately
#[derive(Debug, Args)]
#[command(after_help = help("bspscope measure balls\n\
    bspscope measure scenes/tetra.nff --method midpoint --method sah-cut --d-max auto\n\
    bspscope measure rings --cylinders polygons:10 -o rings.json\n\
    bspscope measure balls:3 --set gap-fraction=0.05 --format csv | head"))]
pub struct MeasureArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<Everything>,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Compare two trees of a scene under equal conditions
///
/// The parameters of classes S and D and the images must be equal. If they are, prints all
/// parameters of both trees, with the second relative to the first. If not, prints what differs
/// and exits with code 1.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope compare balls --a method=midpoint --b method=sah-cut\n\
    bspscope compare rings --a method=sah-cut --b method=sah-cut,gap-fraction=0.05 --format json\n\
    bspscope compare balls --a method=midpoint --b method=sah --per-kind"))]
pub struct CompareArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    /// The first setup: method=NAME and any other settings, by the names of their options and of
    /// the settings of methods, separated by commas
    #[arg(long, value_name = "SETTINGS", help_heading = "Tree")]
    pub a: Edits,
    /// The second setup, in the same form
    #[arg(long, value_name = "SETTINGS", help_heading = "Tree")]
    pub b: Edits,
    /// Also print the counts per kind of ray (primary, shadow, reflected, refracted): the total,
    /// the average per ray, and the maximum
    #[arg(long, help_heading = "Output")]
    pub per_kind: bool,
    #[command(flatten)]
    pub settings: SettingArgs<Shared>,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Repeat the paper's experiment: its Tables 4, 5 and 6 next to our results
///
/// Marks every cell as equal after rounding, same direction (from method 1 to method 2), or
/// different, and explains known differences. The conditions are those of the paper: cylinders as
/// 10 polygons, D_MAX 20, N_OILF 1, D_AREC of Table 4, 512 x 512 pixels. Exits with code 1 if the
/// images of the two methods differ.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  bspscope paper\n  bspscope paper balls rings tetra --format json\n  \
    bspscope paper room -o room.tex"
)]
pub struct PaperArgs {
    /// Scenes of the paper [default: all six]
    #[arg(value_name = "SCENE", value_parser = paper_scenes())]
    pub scenes: Vec<&'static PaperScene>,
    #[command(flatten)]
    pub settings: SettingArgs<Reproduced>,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Find how long nodes and tests take: the times in the paper's equation (1)
///
/// Finds them by regression over a set of trees (the paper's methods, depths around the automatic
/// one, two leaf sizes), with 95 % confidence intervals, and by timing in place. Tests the result
/// on trees that were not part of the fit.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope model balls\n\
    bspscope model balls rings tetra --cylinders polygons:10 --equation printed --format json"))]
pub struct ModelArgs {
    /// Scene files or generators
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<String>,
    #[command(flatten)]
    pub settings: SettingArgs<Modelled>,
    /// How to count tests that hit: all of them, or as printed in the paper's equation (1)
    #[arg(long, value_name = "HOW", value_parser = equation_names(), default_value = "corrected")]
    pub equation: Equation,
    /// How often to time each tree; the shortest time is used
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..))]
    pub rounds: u32,
    /// Output format
    #[arg(long, value_enum, default_value_t = ListFormat::Text, help_heading = "Output")]
    pub format: ListFormat,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

/// Measure a scene for every combination of settings
///
/// Every combination is measured once and becomes one row of the file. An interrupted sweep resumes
/// after the last complete row; existing rows are kept, with their times. Counts are the same in
/// every run. At the end, prints the best settings, compared with the automatic rule
/// D_MAX = 1.2 log2 N + 2.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope sweep balls -o balls.csv --chart balls.svg\n\
    bspscope sweep tetra --method sah-cut --d-max 8..24 --n-oilf 1,2,4 -o tetra.jsonl\n\
    bspscope sweep rings --shard 2/4 -o rings-2.csv"))]
pub struct SweepArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    /// Build methods, separated by commas [default: the paper's two]
    #[arg(long, value_name = "METHODS", value_parser = method_names(), value_delimiter = ',', help_heading = "Axes")]
    pub method: Vec<Method>,
    /// Maximum depths: numbers, ranges such as 8..24, and auto, separated by commas. The same as
    /// --vary d-max=DEPTHS [default without --vary: 1..30]
    #[arg(long, value_name = "DEPTHS", help_heading = "Axes")]
    pub d_max: Option<String>,
    /// Leaf sizes: numbers and ranges, separated by commas. The same as --vary n-oilf=SIZES
    /// [default without --vary: 1,2,4,8]
    #[arg(long, value_name = "SIZES", help_heading = "Axes")]
    pub n_oilf: Option<String>,
    /// Vary any setting: values separated by commas, such as precision=f32,f64 or
    /// root-margin=0,0.001; integers also as ranges. Can be repeated to measure all combinations
    #[arg(long, value_name = "NAME=VALUES", help_heading = "Axes")]
    pub vary: Vec<String>,
    #[command(flatten)]
    pub settings: SettingArgs<Swept>,
    /// Measure only one part of the rows: I/N, with I from 1 to N
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    pub shard: Shard,
    /// Write the rows to this file: .csv, or .jsonl for JSON lines
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: PathBuf,
    #[command(flatten)]
    pub charts: ChartArgs,
}

/// Find the best tree for a scene
///
/// Measures all build methods with their defaults on a picture 128 pixels wide, with the shape of the given one;
/// method none only in scenes of at most 5000 objects. Then measures them with other depths, leaf sizes, widths and
/// densities, more than 200 candidates in all. The better half is timed again, the better half of these twice more,
/// and so on, until one or two are left or the time is spent. Candidates whose ranges of times overlap share a rank.
/// At the end, prints the recommended settings as a command.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope tune balls\n\
    bspscope tune model.obj --kernel stream --resolution 1920x1080\n\
    bspscope tune rings --for memory --budget 20 --format json -o rings.json"))]
pub struct TuneArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    /// What the tree should be best for
    #[arg(long = "for", value_name = "GOAL", value_parser = goal_names(), default_value = "time")]
    pub goal: Goal,
    /// Build once and trace this many rays: rank by the time of both instead of the rendering time
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub rays: Option<u64>,
    /// Leave out trees that need more memory than this many MiB (M_TREE)
    #[arg(long, value_name = "MIB", value_parser = mebibytes)]
    pub max_memory: Option<u64>,
    /// Time for the measurements in seconds. Every method is measured at least once with its defaults; what was left
    /// out is listed
    #[arg(long, value_name = "SECONDS", value_parser = seconds, default_value = "60", allow_negative_numbers = true)]
    pub budget: Duration,
    #[command(flatten)]
    pub settings: SettingArgs<Tuned>,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Merge the parts of a sweep
///
/// The parts are the files of its shards, in any order. If a row occurs twice, the first is kept;
/// the counts of both must be equal. Exits with code 1 if rows are missing, after writing the rest.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  bspscope merge rings-1.csv rings-2.csv -o rings.csv\n  \
    bspscope merge rings.csv -o rings.jsonl --show N_AT --chart rings.png"
)]
pub struct MergeArgs {
    /// Files to merge: .csv or .jsonl
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Write the rows to this file: .csv, or .jsonl for JSON lines
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: PathBuf,
    #[command(flatten)]
    pub charts: ChartArgs,
}

/// Charts and summary of a sweep.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct ChartArgs {
    /// Draw a chart: .png or .svg. Can be repeated
    #[arg(long, value_name = "FILE")]
    pub chart: Vec<PathBuf>,
    /// The parameter to draw and to minimize
    #[arg(long, value_name = "SYMBOL", value_parser = parameter_names(), default_value = "T_TR")]
    pub show: ByParameter,
}

/// Render the picture, or a heatmap of the cost of its pixels, to a PNG or OpenEXR file
#[derive(Debug, Args)]
#[command(after_help = help("bspscope render balls -o balls.png\n\
    bspscope render teaching --resolution 1280x960 --samples 16 -o teaching.exr\n\
    bspscope render balls --show N_NODES -o heat.png\n\
    bspscope render rings --show N_IT --rays shadow --scale log --range 0:500 -o tests.png\n\
    bspscope render tetra --method sah-cut --show T_PIXEL --blend 0.6 -o time.png"))]
pub struct RenderArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<OneMethod>,
    #[command(flatten)]
    pub heat: HeatArgs,
    /// Write to this file: .png (8-bit sRGB) or .exr (linear 32-bit float). A heatmap as .png has a
    /// legend; as .exr it has the raw values in one channel named after the symbol, NaN for no
    /// value
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: PathBuf,
}

/// A heatmap instead of the picture.
#[derive(Debug, Args)]
#[command(next_help_heading = "Heatmap")]
pub struct HeatArgs {
    /// Show a heatmap of this count per pixel
    #[arg(long, value_name = "SYMBOL", value_parser = heatmap_names(), ignore_case = true)]
    pub show: Option<ByHeatmap>,
    /// The rays to include
    #[arg(long, value_name = "KIND", value_parser = filter_names(), default_value = "all", requires = "show")]
    pub rays: RayFilter,
    /// Scale of the colors [default: linear]
    #[arg(long, value_name = "SCALE", value_parser = scale_names(), requires = "show")]
    pub scale: Option<Scale>,
    /// Range of the colors, to make pictures comparable [default: lowest to highest value]
    #[arg(long, value_name = "LO:HI", value_parser = range, requires = "show", allow_hyphen_values = true)]
    pub range: Option<Range>,
    /// Color map; all are suitable for color-blind people [default: viridis]
    #[arg(long, value_name = "NAME", value_parser = colormap_names(), requires = "show")]
    pub colors: Option<ByColormap>,
    /// Opacity of the heatmap over the picture, from 0 to 1 [default: 1]
    #[arg(long, value_name = "SHARE", value_parser = share, requires = "show")]
    pub blend: Option<f64>,
}

/// Print everything that the rays of one pixel did in the tree
///
/// Prints the whole tree of rays. For each ray, prints in order every inner node with its plane,
/// every leaf with its tests, the hit, and why traversal continued or ended.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope probe balls --pixel 256,256\n\
    bspscope probe teaching --pixel 100,80 --resolution 320x240 --method sah-cut\n\
    bspscope probe scenes/rings.nff --pixel 300,200 --format json -o pixel.json"))]
pub struct ProbeArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    /// Column and row of the pixel; 0,0 is the upper left pixel
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true, help_heading = "Picture")]
    pub pixel: [i64; 2],
    #[command(flatten)]
    pub settings: SettingArgs<Everything>,
    /// Output format
    #[arg(long, value_enum, default_value_t = ListFormat::Text, help_heading = "Output")]
    pub format: ListFormat,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

/// Measure, and write pictures, tables, settings and machine as one HTML file
///
/// The page is self-contained: it can be sent, archived and printed. With two methods, the second
/// is also shown relative to the first.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope report balls -o balls.html\n\
    bspscope report scenes/tetra.nff --method sah-cut --d-max auto -o tetra.html"))]
pub struct PageArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<Everything>,
    /// Write the page to this file
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: PathBuf,
}

/// Write a tree to a file (.bstree) that other programs can read
///
/// Options --method and --tree of other commands read such a file, of this or another program:
/// 'bspscope measure SCENE --tree FILE'. The format is described in docs/formats.md.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope tree balls --method bvh-sweep --set width=8 -o balls.bstree\n\
    bspscope measure balls --tree balls.bstree\n\
    bspscope verify balls --tree balls.bstree"))]
pub struct TreeArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<Built>,
    /// Write to this file; - writes to standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: PathBuf,
}

/// Write the leaf boxes of a tree as OBJ or PLY, for other programs
///
/// Every leaf is a box of 6 faces in the scene's units, counter-clockwise when seen from outside.
/// Node, depth and number of objects are in the names of the objects (OBJ) or properties of the
/// faces (PLY).
#[derive(Debug, Args)]
#[command(after_help = help("bspscope leaves balls -o leaves.ply\n\
    bspscope leaves rings --method sah-cut --only full -o full.obj"))]
pub struct LeavesArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<Built>,
    /// Which leaves to write [default: all]
    #[arg(long, value_enum, value_name = "LEAVES")]
    pub only: Option<LeavesShown>,
    /// Output format [default: by the extension of -o, or obj]
    #[arg(long, value_name = "FORM", value_parser = leaf_writer_names(), help_heading = "Output")]
    pub format: Option<String>,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LeavesShown {
    /// Leaves with objects
    Full,
    /// Leaves without objects
    Empty,
}

/// Write a scene, generated or read, as an NFF file
#[derive(Debug, Args)]
#[command(after_help = help("bspscope generate balls:4 -o balls.nff\n\
    bspscope generate rings --cylinders polygons:10 > rings.nff\n\
    bspscope generate model.glb -o model.nff"))]
pub struct GenerateArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<Loaded>,
    /// Write to this file [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// List the build methods and their settings
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  bspscope methods\n  bspscope methods --format json")]
pub struct MethodsArgs {
    /// Output format
    #[arg(long, value_enum, default_value_t = ListFormat::Text)]
    pub format: ListFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ListFormat {
    Text,
    Json,
}

/// Check trees, and compare their hits with testing every object
///
/// If two hits differ, exact arithmetic decides whether it is a tie (both are exactly right) or a
/// fault. Exits with code 1 if a tree is invalid or there is a fault. The first faults are written
/// to fault.json, fault-1.json and so on, each with as few objects as needed to reproduce it.
///
/// With --exact, every answer is compared with exact arithmetic instead: of testing every object and
/// of every tree, by every kernel of this processor, in f64 and f32. The rays are random ones, rays of
/// the picture, and rays at the limits of rounding.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope verify\n\
    bspscope verify teaching scenes/balls.nff --rays 10000 --method sah-cut\n\
    bspscope verify balls --exact 100000\n\
    bspscope verify --replay fault.json"))]
pub struct VerifyArgs {
    /// Scene files or generators [default: all generators]
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Repeat the fault in this file, and nothing else
    #[arg(long, value_name = "FILE", conflicts_with = "scenes")]
    pub replay: Option<PathBuf>,
    /// Compare the answers about N rays per scene and precision with exact arithmetic
    #[arg(long, value_name = "N", conflicts_with_all = ["replay", "rays"], value_parser = clap::value_parser!(u32).range(1..))]
    pub exact: Option<u32>,
    /// Number of rays to compare, per scene and kind
    #[arg(long, value_name = "N", default_value_t = 50_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub rays: u32,
    #[command(flatten)]
    pub settings: SettingArgs<Verified>,
}

/// Check the answers of another program about rays
///
/// Rays and answers are files: .csv with titles (ox, oy, oz, dx, dy, dz and optionally t_min and t_max;
/// object and t, or blocked), or .f32 and .f64 with eight and two numbers per ray. Object -1 is a miss.
/// Exact arithmetic decides whether each answer is right, a tie, right up to rounding, or a fault. The
/// first faults are written to fault.json, fault-1.json and so on, each with as few objects as needed.
/// Exits with code 1 if there is a fault.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope check model.obj --rays rays.csv --answers answers.csv\n\
    bspscope check terrain.ply --rays rays.f32 --answers answers.f32 --precision f32\n\
    bspscope verify --replay fault.json"))]
pub struct CheckArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    /// The rays
    #[arg(long, value_name = "FILE")]
    pub rays: PathBuf,
    /// The answers, one per ray
    #[arg(long, value_name = "FILE")]
    pub answers: PathBuf,
    /// The precision in which the program computes
    #[arg(long, value_name = "NAME", value_parser = precision_names(), default_value = "f32")]
    pub precision: Precision,
    #[command(flatten)]
    pub settings: SettingArgs<Answered>,
}

/// Test trees with extreme rays, geometry, transformations and settings
///
/// Prints a table of cases by methods and precisions. Each entry is a pass, a failure with its
/// reason, or not representable in that precision. Exits with code 1 if any case fails.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope stability\n\
    bspscope stability --quick --format json -o stability.json\n\
    bspscope stability scenes/rings.nff --method sah-cut"))]
pub struct StabilityArgs {
    /// Scene for the cases that apply to any scene [default: the built-in test scenes]
    pub scene: Option<String>,
    /// Use fewer rays and smaller pictures: takes seconds instead of minutes
    #[arg(long)]
    pub quick: bool,
    #[command(flatten)]
    pub settings: SettingArgs<Extreme>,
    /// Output format
    #[arg(long, value_enum, default_value_t = ListFormat::Text, help_heading = "Output")]
    pub format: ListFormat,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

/// Measure accuracy vs. time: rendering time and error of each setting
///
/// Varies each setting alone and all together: precision, samples, D_AREC, minimum contribution,
/// polygons per cylinder, resolution. The reference uses f64, exact shapes and secondary rays at
/// least 8 deep. Settings that change only the time (method, D_MAX, N_OILF) are listed separately.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope accuracy rings\n\
    bspscope accuracy balls --only precision --rounds 9\n\
    bspscope accuracy balls:3 --resolution 256x256 --samples 4 --format csv -o accuracy.csv"))]
pub struct AccuracyArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<Reference>,
    /// Vary only this setting, alone. Can be repeated [default: all, alone and together]
    #[arg(long, value_name = "CHOICE", value_parser = knob_names())]
    pub only: Vec<&'static Knob>,
    /// Number of rounds; every choice is timed once per round
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    pub rounds: u32,
    /// Output format
    #[arg(long, value_enum, default_value_t = AccuracyFormat::Text, help_heading = "Output")]
    pub format: AccuracyFormat,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AccuracyFormat {
    Text,
    Json,
    Csv,
}

/// List, check and print the lessons
///
/// Lessons are guided tours that ask for a prediction before they show the figures. Open them in
/// the window: Ctrl+J lists them.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  bspscope lesson list\n  bspscope lesson check\n  \
    bspscope lesson check mine.md\n  bspscope lesson show one-ray"
)]
pub struct LessonArgs {
    #[command(subcommand)]
    pub command: LessonCommand,
}

#[derive(Debug, Subcommand)]
pub enum LessonCommand {
    /// List the lessons that come with the program
    List,
    /// Measure the steps of lessons and check that what they state is true
    ///
    /// All conditions are on counts, which are the same on every machine. Prints conditions that do
    /// not hold with file, line and reason and exits with code 1; exits with code 2 if a file is
    /// not a lesson.
    Check {
        /// Names of lessons, or files [default: all that come with the program]
        #[arg(value_name = "LESSON")]
        lessons: Vec<String>,
    },
    /// Print a lesson as Markdown, with the figures and answers of this machine
    Show {
        /// Name of a lesson, or a file
        #[arg(value_name = "LESSON")]
        lesson: String,
    },
}

/// Output format and file of a report.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct ReportArgs {
    /// Output format [default: by the extension of -o, or text]
    #[arg(long, value_name = "FORM", value_parser = writer_names())]
    pub format: Option<String>,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Returns the examples, generators and file formats for the end of a help text.
fn help(examples: &str) -> String {
    let mut text = "Examples:".to_owned();
    for example in examples.lines() {
        text += &format!("\n  {example}");
    }
    text += "\n\nGenerators:";
    for builtin in BUILTINS {
        let sizes = &builtin.sizes;
        text += &format!(
            "\n  {} (sizes {} to {}, default {})\n      {}",
            builtin.name,
            sizes.start(),
            sizes.end(),
            builtin.default_size,
            builtin.about
        );
    }
    text += "\n\nScene files, recognized by content or extension:";
    for format in FORMATS {
        let extensions = format.extensions.join(", .");
        text += &format!("\n  .{extensions}\n      {}", format.about);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{SceneRequest, SceneSource};
    use crate::setup::Setup;
    use crate::setup::measure_command;
    use crate::structure::BuildSettings;
    use clap::CommandFactory;

    #[test]
    fn the_definition_is_sound() {
        Arguments::command().debug_assert();
    }

    /// The setups of a line of arguments of `measure`.
    fn measured(words: &[String]) -> Vec<Setup> {
        let Some(Command::Measure(args)) = Arguments::parse_from(words).command else {
            panic!("not a measurement: {words:?}");
        };
        args.settings.setups(&args.scene).unwrap()
    }

    #[test]
    fn the_defaults_are_those_of_the_library() {
        let setups = measured(&["bspscope", "measure", "balls"].map(String::from));
        let expected = Method::of_the_paper().into_iter().map(|method| Setup {
            build: BuildSettings::for_method(method),
            ..Setup::default()
        });
        assert_eq!(setups, expected.collect::<Vec<_>>());
    }

    #[test]
    fn a_copied_command_measures_with_the_same_settings() {
        let mut plain = Setup::new(SceneRequest::parse("balls:3"));
        plain.build = BuildSettings::for_method(Method::named("sah-cut").unwrap());
        let mut all: Vec<Setup> = Method::all()
            .map(|method| Setup {
                build: BuildSettings::for_method(method),
                ..plain.clone()
            })
            .collect();
        for setting in plain.settings() {
            all.extend(setting.examples().into_iter().map(|value| {
                let mut setup = plain.clone();
                setting.store(&mut setup, value);
                setup
            }));
        }
        assert!(all.len() > 40);
        let mut other = plain.clone();
        for setting in plain.settings() {
            if setting.name != "method" {
                setting.store(&mut other, setting.examples()[0]);
            }
        }
        let file = "/not/there/it's -- a \"scene\" $HOME.nff";
        other.scene.source = SceneSource::File(file.into());
        all.push(other);
        for setup in &all {
            let line = measure_command(setup);
            let words = shell_words::split(&line).unwrap();
            assert_eq!(measured(&words), std::slice::from_ref(setup), "{line}");
        }
        plain.build = BuildSettings::default();
        let line = measure_command(&plain);
        let expected = "bspscope measure balls:3 --method midpoint --resolution 512x512 --d-arec 4";
        assert_eq!(line, expected);
    }
}
