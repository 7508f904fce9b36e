//! A build method in one file: it splits every cell in the middle of its longest side.
//!
//! A program that uses the library can define a method like this. To add one to bspscope itself,
//! put the same code into a file in `src/structure/split/` and add its `METHOD` to `SPLIT_RULES`
//! there. The command line, the window and the tests over all methods then include it.
//!
//! `cargo run --release --example build_method [SCENE]`

use bspscope::geometry::Axis;
use bspscope::measure::{DELTA, measure, parameter};
use bspscope::progress::Progress;
use bspscope::scene::{SceneRequest, load};
use bspscope::structure::split::{Cell, Decision, MethodInfo, SplitRule, Structure};
use bspscope::structure::{BuildSettings, Builder, Method, validate};
use bspscope::trace::RenderSettings;

/// The description of the method.
static METHOD: MethodInfo = MethodInfo {
    name: "longest-side",
    summary: "splits the longest side in the middle",
    about: "Splits every cell in the middle of its longest side.",
    source: "this example",
    paper: None,
    paper_spheres_exactly: true,
    structure: Structure::Bintree,
    has_limits: true,
    constants: &[],
    builder: Builder::Cells(|_| Box::new(LongestSide)),
};

struct LongestSide;

impl SplitRule for LongestSide {
    /// Decides on a cell that contains more than `N_OILF` objects and is above depth `D_MAX`. The
    /// build driver handles both limits, the objects on both sides, threads and memory.
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let size = cell.bounds.size();
        let longest = Axis::ALL
            .into_iter()
            .max_by(|a, b| size[a.index()].total_cmp(&size[b.index()]));
        let axis = longest.expect("there are three");
        Decision::Split {
            axis,
            plane: cell.midpoint(axis),
        }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args().nth(1).unwrap_or("balls:3".into());
    let progress = Progress::new();
    let scene = load(&SceneRequest::parse(&name), &progress)?;
    let render = RenderSettings {
        width: 256,
        height: 256,
        ..RenderSettings::for_camera(*scene.camera())
    };
    let methods = [Method::named("midpoint")?, Method::new(&METHOD)];
    let mut measured = Vec::new();
    for method in methods {
        let settings = BuildSettings::for_method(method);
        measured.push(measure(&scene, &settings, &render, &progress)?);
    }
    let [midpoint, ours] = &measured[..] else {
        unreachable!("there are two methods");
    };
    // Every object in every leaf that it touches, no volume lost: whatever planes are chosen.
    validate(&scene, &ours.tree)?;
    assert_eq!(
        ours.picture, midpoint.picture,
        "no picture depends on the tree"
    );
    println!("{:8} {:>12} {:>12}", "", "midpoint", METHOD.name);
    for symbol in DELTA {
        let parameter = parameter(symbol);
        let [a, b] = [midpoint, ours].map(|m| parameter.format(parameter.value(&m.measurement)));
        println!("{symbol:8} {a:>12} {b:>12}  {}", parameter.name);
    }
    Ok(())
}
