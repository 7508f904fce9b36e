//! The arguments as they are typed; the settings among them are made from the list of settings ([`super::setting_args`]).

use super::setting_args::{
    Built, Everything, Extreme, Loaded, Modelled, OneMethod, Reference, Reproduced, SettingArgs,
    Shared, Swept, Verified,
};
use super::values::{
    ByColormap, ByHeatmap, ByParameter, colormap_names, equation_names, filter_names,
    heatmap_names, knob_names, leaf_writer_names, method_names, paper_scenes, parameter_names,
    pixel, range, scale_names, share, writer_names,
};
use crate::measure::accuracy::Knob;
use crate::measure::heat::RayFilter;
use crate::measure::model::Equation;
use crate::measure::paper::PaperScene;
use crate::measure::sweep::Shard;
use crate::present::overlay::{Range, Scale};
use crate::scene::builtin::BUILTINS;
use crate::scene::format::FORMATS;
use crate::setup::Edits;
use crate::structure::Method;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// See, measure and compare the BSP trees that make ray tracing fast.
///
/// Without a command it opens the window. Without a display it measures the scene with both of the
/// paper's methods instead and writes the picture to a file.
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
    Paper(PaperArgs),
    Render(RenderArgs),
    Report(PageArgs),
    Leaves(LeavesArgs),
    Sweep(SweepArgs),
    Probe(ProbeArgs),
    Generate(GenerateArgs),
    Methods(MethodsArgs),
    Verify(VerifyArgs),
    Stability(StabilityArgs),
    #[command(alias = "trade")]
    Accuracy(AccuracyArgs),
    Lesson(LessonArgs),
}

/// Open the window; the same as no command
#[derive(Debug, Args)]
pub struct WindowArgs {
    /// What to open: a scene file, a generator with an optional size (NAME or NAME:SIZE), or a
    /// workspace (.bspscope) [default: where the last session ended]
    pub scene: Option<String>,
    /// Open with a lesson: its name (see 'bspscope lesson list'), or a file
    #[arg(long, value_name = "LESSON")]
    pub lesson: Option<String>,
    #[command(flatten)]
    pub settings: SettingArgs<Everything>,
}

/// Measure every parameter of the paper, with Δ and Λ set apart
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

/// Compare two trees of a scene, if they may be compared
///
/// Parameters of class S and D must be equal, and so must the images; if not, says which differ,
/// with exit code 1. Else all parameters of both, with the second relative to the first.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope compare balls --a method=midpoint --b method=sah-cut\n\
    bspscope compare rings --a method=sah-cut --b method=sah-cut,gap-fraction=0.05 --format json\n\
    bspscope compare balls --a method=midpoint --b method=sah --per-kind"))]
pub struct CompareArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    /// The first setup: method=NAME, and any other setting by the name of its option, a method's own
    /// ones too, separated by commas
    #[arg(long, value_name = "SETTINGS", help_heading = "Tree")]
    pub a: Edits,
    /// The second setup, likewise
    #[arg(long, value_name = "SETTINGS", help_heading = "Tree")]
    pub b: Edits,
    /// Tell what rays did kind by kind, too: primary, shadow, reflected and refracted ones, all
    /// together, a ray on average, and the ray with the most
    #[arg(long, help_heading = "Output")]
    pub per_kind: bool,
    #[command(flatten)]
    pub settings: SettingArgs<Shared>,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Repeat the paper's experiment: its Tables 4, 5 and 6, printed beside computed
///
/// Every cell is marked: equal after rounding, same direction (from method 1 to method 2), or
/// differs; what is known of the difference is said. Conditions are the paper's: cylinders as 10
/// polygons, D_MAX 20, N_OILF 1, D_AREC of Table 4, 512 x 512 pixels. Exit code 1 if the two methods
/// gave different images.
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

/// Find what tests and traversal take: the times of the paper's equation (1)
///
/// By regression over a set of trees (the paper's methods, depths around the automatic one, two leaf
/// sizes), with 95 % confidence intervals, and by timing in place. The times are tested on trees
/// that were left out of the fit.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope model balls\n\
    bspscope model balls rings tetra --cylinders polygons:10 --equation printed --format json"))]
pub struct ModelArgs {
    /// Scenes, files or generators
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<String>,
    #[command(flatten)]
    pub settings: SettingArgs<Modelled>,
    /// How tests that hit are counted: every one, or as the paper's equation (1) has it
    #[arg(long, value_name = "HOW", value_parser = equation_names(), default_value = "corrected")]
    pub equation: Equation,
    /// How often each tree is timed; the least time counts
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..))]
    pub rounds: u32,
    /// Form of the result
    #[arg(long, value_enum, default_value_t = ListFormat::Text, help_heading = "Output")]
    pub format: ListFormat,
    /// Write to this file in place of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

/// Measure a scene over a grid of build methods, depths and leaf sizes
///
/// Every point is measured once and becomes a row of the file, in the order of the grid: methods,
/// leaf sizes, depths. Run again, a sweep that was broken off goes on after the last whole row; rows
/// that are there stay as they are, with their times. What no machine changes is the same in every
/// run. In the end the best settings are told, beside the automatic rule 1.2 log2 N + 2.
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
    /// Maximum depths: numbers, ranges such as 8..24, and auto, separated by commas; the same as
    /// --vary d-max=DEPTHS [default without --vary: 1..30]
    #[arg(long, value_name = "DEPTHS", help_heading = "Axes")]
    pub d_max: Option<String>,
    /// Leaf sizes: numbers and ranges, separated by commas; the same as --vary n-oilf=SIZES [default
    /// without --vary: 1,2,4,8]
    #[arg(long, value_name = "SIZES", help_heading = "Axes")]
    pub n_oilf: Option<String>,
    /// Values of any setting, separated by commas, such as precision=f32,f64 or
    /// root-margin=0,0.001; whole numbers also as ranges. May be given more than once: all
    /// combinations are measured
    #[arg(long, value_name = "NAME=VALUES", help_heading = "Axes")]
    pub vary: Vec<String>,
    #[command(flatten)]
    pub settings: SettingArgs<Swept>,
    /// Measure only this part of the points: I/N, with I from 1 to N
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    pub shard: Shard,
    /// File for the rows: .csv, or .jsonl for JSON lines
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: PathBuf,
    #[command(flatten)]
    pub charts: ChartArgs,
}

/// Put the parts of a sweep together
///
/// Parts are the files of its shards, in any order. Of a point that is there twice the first is
/// kept; its counts must be equal. Exit code 1 if points are missing; what is there is written.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  bspscope merge rings-1.csv rings-2.csv -o rings.csv\n  \
    bspscope merge rings.csv -o rings.jsonl --show N_AT --chart rings.png"
)]
pub struct MergeArgs {
    /// Files of rows: .csv or .jsonl
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// File for the rows: .csv, or .jsonl for JSON lines
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: PathBuf,
    #[command(flatten)]
    pub charts: ChartArgs,
}

/// What is told and drawn of a sweep.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct ChartArgs {
    /// Draw the rows: .png or .svg; may be given more than once
    #[arg(long, value_name = "FILE")]
    pub chart: Vec<PathBuf>,
    /// The parameter that is drawn, and by whose least value settings are best
    #[arg(long, value_name = "SYMBOL", value_parser = parameter_names(), default_value = "T_TR")]
    pub show: ByParameter,
}

/// Render the picture, or a heatmap of what its pixels cost, to a PNG or OpenEXR file
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
    /// Picture file: .png is 8-bit sRGB, .exr is linear 32-bit float. A heatmap as .png has its
    /// legend, as .exr the raw values in one channel named after the symbol, NaN without a value
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: PathBuf,
}

/// A heatmap in place of the picture.
#[derive(Debug, Args)]
#[command(next_help_heading = "Heatmap")]
pub struct HeatArgs {
    /// What is shown of every pixel
    #[arg(long, value_name = "SYMBOL", value_parser = heatmap_names(), ignore_case = true)]
    pub show: Option<ByHeatmap>,
    /// The rays that are looked at
    #[arg(long, value_name = "KIND", value_parser = filter_names(), default_value = "all", requires = "show")]
    pub rays: RayFilter,
    /// How values spread over the colours [default: linear]
    #[arg(long, value_name = "SCALE", value_parser = scale_names(), requires = "show")]
    pub scale: Option<Scale>,
    /// Values that the colours span, so that pictures can be compared [default: lowest to highest]
    #[arg(long, value_name = "LO:HI", value_parser = range, requires = "show", allow_hyphen_values = true)]
    pub range: Option<Range>,
    /// Colours; colour-blind people can read all of them [default: viridis]
    #[arg(long, value_name = "NAME", value_parser = colormap_names(), requires = "show")]
    pub colors: Option<ByColormap>,
    /// How much the colours hide of the picture below them, 0 to 1 [default: 1]
    #[arg(long, value_name = "SHARE", value_parser = share, requires = "show")]
    pub blend: Option<f64>,
}

/// Tell everything that the rays of one pixel did in the tree
///
/// The whole tree of rays; of every ray, in order, every inner node with its plane, every leaf with
/// its tests, what was hit, and why the walk went on or ended.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope probe balls --pixel 256,256\n\
    bspscope probe teaching --pixel 100,80 --resolution 320x240 --method sah-cut\n\
    bspscope probe scenes/rings.nff --pixel 300,200 --format json -o pixel.json"))]
pub struct ProbeArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    /// Column and row of the pixel; 0,0 is the upper left
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true, help_heading = "Picture")]
    pub pixel: [i64; 2],
    #[command(flatten)]
    pub settings: SettingArgs<Everything>,
    /// Form of the record
    #[arg(long, value_enum, default_value_t = ListFormat::Text, help_heading = "Output")]
    pub format: ListFormat,
    /// Write to this file in place of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

/// Measure, and write pictures, tables, settings and machine as one HTML file
///
/// The page refers to nothing outside of it: it can be sent, kept and printed. With two methods the
/// second stands relative to the first.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope report balls -o balls.html\n\
    bspscope report scenes/tetra.nff --method sah-cut --d-max auto -o tetra.html"))]
pub struct PageArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<Everything>,
    /// File for the page
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: PathBuf,
}

/// Write the boxes of a tree's leaves for other programs: OBJ or PLY
///
/// Every leaf is a box of 6 faces in the scene's units, outward faces counter-clockwise; node, depth
/// and number of objects stand in the names of OBJ's objects and as properties of PLY's faces.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope leaves balls -o leaves.ply\n\
    bspscope leaves rings --method sah-cut --only full -o full.obj"))]
pub struct LeavesArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<Built>,
    /// Only these leaves [default: all]
    #[arg(long, value_enum, value_name = "LEAVES")]
    pub only: Option<LeavesShown>,
    /// Form of the boxes; without it the extension of -o decides, or obj
    #[arg(long, value_name = "FORM", value_parser = leaf_writer_names(), help_heading = "Output")]
    pub format: Option<String>,
    /// Write to this file in place of standard output
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

/// Write a scene, generated or read, as a scene file (NFF)
#[derive(Debug, Args)]
#[command(after_help = help("bspscope generate balls:4 -o balls.nff\n\
    bspscope generate rings --cylinders polygons:10 > rings.nff\n\
    bspscope generate model.glb -o model.nff"))]
pub struct GenerateArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<Loaded>,
    /// Scene file to write; '-' or nothing writes to standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// List the build methods and their settings
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  bspscope methods\n  bspscope methods --format json")]
pub struct MethodsArgs {
    /// Form of the list
    #[arg(long, value_enum, default_value_t = ListFormat::Text)]
    pub format: ListFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ListFormat {
    Text,
    Json,
}

/// Check trees, and their hits ray for ray against testing every object
///
/// Where an answer differs, exact arithmetic says why: a tie (both are exactly right) or a fault.
/// Exit code 1 if a tree is not valid or there is a fault; the first faults are written to
/// fault.json, fault-1.json and so on, with as few objects as show them.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope verify\n\
    bspscope verify teaching scenes/balls.nff --rays 10000 --method sah-cut\n\
    bspscope verify --replay fault.json"))]
pub struct VerifyArgs {
    /// Scenes, files or generators [default: all generators]
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Ask the question of a fault's file again, and nothing else
    #[arg(long, value_name = "FILE", conflicts_with = "scenes")]
    pub replay: Option<PathBuf>,
    /// Rays of every kind and scene that are compared
    #[arg(long, value_name = "N", default_value_t = 50_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub rays: u32,
    #[command(flatten)]
    pub settings: SettingArgs<Verified>,
}

/// Try trees at the extremes: tough rays, geometry, transforms and settings
///
/// A matrix of cases by methods and precisions, each a pass, a failure with its reason, or not
/// representable in that precision. Exit code 1 if anything fails.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope stability\n\
    bspscope stability --quick --format json -o stability.json\n\
    bspscope stability scenes/rings.nff --method sah-cut"))]
pub struct StabilityArgs {
    /// Scene to try the cases on that apply to any [default: the built-in torture set]
    pub scene: Option<String>,
    /// Fewer rays and smaller pictures: seconds in place of minutes
    #[arg(long)]
    pub quick: bool,
    #[command(flatten)]
    pub settings: SettingArgs<Extreme>,
    /// Form of the matrix
    #[arg(long, value_enum, default_value_t = ListFormat::Text, help_heading = "Output")]
    pub format: ListFormat,
    /// Write to this file in place of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

/// Tell what accuracy costs: choices that buy speed with it, by time and error
///
/// Every choice alone, and all together: precision, samples, D_AREC, cut-off, polygons a cylinder,
/// resolution. The reference is f64 with exact shapes and secondary rays at least 8 deep. Choices that
/// move only the time (method, D_MAX, N_OILF) stand apart.
#[derive(Debug, Args)]
#[command(after_help = help("bspscope accuracy rings\n\
    bspscope accuracy balls --only precision --rounds 9\n\
    bspscope accuracy balls:3 --resolution 256x256 --samples 4 --format csv -o accuracy.csv"))]
pub struct AccuracyArgs {
    /// A scene file, or a generator with an optional size (NAME or NAME:SIZE)
    pub scene: String,
    #[command(flatten)]
    pub settings: SettingArgs<Reference>,
    /// Only this choice, alone; may be given more than once [default: all, alone and together]
    #[arg(long, value_name = "CHOICE", value_parser = knob_names())]
    pub only: Vec<&'static Knob>,
    /// Rounds in which every choice is timed once
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    pub rounds: u32,
    /// Form of the report
    #[arg(long, value_enum, default_value_t = AccuracyFormat::Text, help_heading = "Output")]
    pub format: AccuracyFormat,
    /// Write to this file in place of standard output
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AccuracyFormat {
    Text,
    Json,
    Csv,
}

/// List, check and print the lessons: guided tours that ask for a prediction, then tell
///
/// They are taken in the window; Ctrl+J there lists them.
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
    /// Measure what lessons look at, and check that what they say holds
    ///
    /// Everything expected is a count, the same on every machine. What does not hold is told with
    /// file, line and reason, with exit code 1; a file that is no lesson has exit code 2.
    Check {
        /// Names of lessons, or files [default: all that come with the program]
        #[arg(value_name = "LESSON")]
        lessons: Vec<String>,
    },
    /// Print a lesson with its figures and answers as they are on this machine, in Markdown
    Show {
        /// Name of a lesson, or a file
        #[arg(value_name = "LESSON")]
        lesson: String,
    },
}

/// The form of a report, and where it goes.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct ReportArgs {
    /// Form of the report; without it the extension of -o decides, or text
    #[arg(long, value_name = "FORM", value_parser = writer_names())]
    pub format: Option<String>,
    /// Write to this file in place of standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Examples, the scenes that can be generated, and the files that can be read.
fn help(examples: &str) -> String {
    let mut text = "Examples:".to_owned();
    for example in examples.lines() {
        text += &format!("\n  {example}");
    }
    text += "\n\nGenerators:";
    for builtin in BUILTINS {
        let sizes = &builtin.sizes;
        text += &format!(
            "\n  {} (sizes {} to {}; {} without one)\n      {}",
            builtin.name,
            sizes.start(),
            sizes.end(),
            builtin.default_size,
            builtin.about
        );
    }
    text += "\n\nScene files, told by their content where the extension does not fit:";
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
    use crate::structure::BuildSettings;
    use crate::workspace::measure_command;
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
