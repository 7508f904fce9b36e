//! How another program calls the library: a scene, two trees of it, and what they cost.
//!
//! `cargo run --release --example measure_scene [SCENE]`

use bspscope::measure::{DELTA, change, measure, parameter, unequal};
use bspscope::progress::Progress;
use bspscope::scene::{SceneRequest, load};
use bspscope::structure::{BuildSettings, MaxDepth, Method};
use bspscope::trace::RenderSettings;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args().nth(1).unwrap_or("balls:3".into());
    // Whoever holds a clone of it can ask how far the work is, or cancel it.
    let progress = Progress::new();
    let scene = load(&SceneRequest::parse(&name), &progress)?;
    let render = RenderSettings {
        width: 256,
        height: 256,
        ..RenderSettings::for_camera(*scene.camera())
    };
    let settings = |method: &str| -> Result<BuildSettings, Box<dyn std::error::Error>> {
        Ok(BuildSettings {
            d_max: MaxDepth::Automatic,
            ..BuildSettings::for_method(Method::named(method)?)
        })
    };
    let a = measure(&scene, &settings("midpoint")?, &render, &progress)?;
    let b = measure(&scene, &settings("sah-cut")?, &render, &progress)?;

    let reasons = unequal((&a.measurement, &a.picture), (&b.measurement, &b.picture));
    for reason in &reasons {
        println!("The two may not be compared: {reason}");
    }
    println!("{}, {} objects", scene.name(), scene.objects().len());
    for symbol in DELTA {
        let parameter = parameter(symbol);
        let [of_a, of_b] = [&a, &b].map(|tree| parameter.value(&tree.measurement));
        let change = change(parameter.unit, of_a, of_b);
        println!(
            "{symbol:8} {:>12} {:>12} {:>14}  {}",
            parameter.format(of_a),
            parameter.format(of_b),
            change.map_or("–".into(), |change| change.to_string()),
            parameter.name
        );
    }
    Ok(())
}
