//! What a step of a lesson looks at: a scene, one or two trees of it, and a picture.

use crate::scene::SceneRequest;
use crate::setup::Setup;
use crate::structure::BuildSettings;
use crate::trace::{PrecisionChoice, RenderSettings};

/// What is built, rendered and shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    pub a: Setup,
    /// The second setup, where two are compared.
    pub b: Option<Setup>,
    /// The pixel whose rays are followed: column and row.
    pub pixel: Option<[u32; 2]>,
    pub look: Look,
}

/// What is brought into view. Names are those that the window shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// Symbol of the heatmap that comes with the answer.
    pub heatmap: Option<&'static str>,
    /// How two pictures share the pane.
    pub view: Option<Named>,
    /// Panes that come to the front of their tabs.
    pub panes: Vec<Named>,
    /// Panels that are unfolded; all others are folded.
    pub panels: Vec<Named>,
}

/// A name with the line of the file where it stands, from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    pub line: usize,
    pub name: String,
}

/// Reads the settings of one of a step's setups as `bspscope compare` takes them, such as
/// `method=sah-cut,d-max=16,d-arec=1`; what is not named is as in `base`.
///
/// # Errors
/// What is wrong, in a sentence.
pub fn parse(text: &str, base: &Setup) -> Result<Setup, String> {
    let mut of_tree = Vec::new();
    let mut of_picture = Vec::new();
    for pair in text.split(',') {
        let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
        match name.trim() {
            name @ ("d-arec" | "cut-off" | "precision" | "cylinders") => {
                of_picture.push((name, value.trim()));
            }
            _ => of_tree.push(pair),
        }
    }
    let build: BuildSettings = of_tree.join(",").parse()?;
    let (mut scene, mut render): (SceneRequest, RenderSettings) = (base.scene.clone(), base.render);
    for (name, value) in of_picture {
        let wrong = |expected: &str| format!("{name}: expected {expected}, found '{value}'");
        match name {
            "d-arec" => {
                render.d_arec = value.parse().map_err(|_| wrong("a whole number"))?;
            }
            "cut-off" => {
                let share = value.parse().ok().filter(|s| (0.0..=1.0).contains(s));
                render.min_contribution = share.ok_or_else(|| wrong("a number from 0 to 1"))?;
            }
            "precision" => {
                let choice = PrecisionChoice::named(value);
                render.precision = choice.ok_or_else(|| wrong("f32, f64 or auto"))?;
            }
            _ => scene.cylinders = value.parse()?,
        }
    }
    Ok(Setup {
        scene,
        build,
        render,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Cylinders;

    #[test]
    fn settings_of_tree_and_picture_stand_in_one_list() {
        let parse = |text: &str| parse(text, &Setup::default());
        let side = parse("method=sah-cut, d-max=12, d-arec=1, precision=f32").unwrap();
        assert_eq!(side.build, "method=sah-cut,d-max=12".parse().unwrap());
        let render = &side.render;
        assert_eq!((render.d_arec, render.precision), (1, PrecisionChoice::F32));
        assert_eq!(side.scene.cylinders, Cylinders::Exact);
        let side = parse("cylinders=polygons:5,method=none,cut-off=0.1").unwrap();
        assert_eq!(side.scene.cylinders, Cylinders::Polygons(5));
        let render = &side.render;
        assert_eq!((render.d_arec, render.min_contribution), (4, 0.1));
        for wrong in [
            "",
            "d-arec=2",
            "method=none,d-arec=x",
            "method=none,precision=f16",
            "method=none,cut-off=2",
            "method=none,colour=1",
        ] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
