//! What a step of a lesson looks at: a scene, one or two trees of it, and a picture.

use crate::scene::{Camera, Cylinders, SceneRequest, SceneSource};
use crate::structure::BuildSettings;
use crate::trace::{PrecisionChoice, RenderSettings};

/// What is built, traced and shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    pub scene: SceneSource,
    /// The first tree.
    pub a: SideSetup,
    /// The second tree, where two are compared.
    pub b: Option<SideSetup>,
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// `None` for the scene's own.
    pub camera: Option<Camera>,
    /// The pixel whose rays are followed: column and row.
    pub pixel: Option<[u32; 2]>,
    pub look: Look,
}

/// A tree, and the settings of the picture that may differ from tree to tree.
#[derive(Clone, Debug, PartialEq)]
pub struct SideSetup {
    pub build: BuildSettings,
    pub cylinders: Cylinders,
    pub d_arec: u32,
    pub cut_off: f64,
    pub precision: PrecisionChoice,
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

impl SideSetup {
    /// Reads the settings of a tree as `bspscope compare` takes them, such as
    /// `method=sah-cut,d-max=16`, and any of `d-arec`, `cut-off`, `precision` and `cylinders`.
    ///
    /// # Errors
    /// What is wrong, in a sentence.
    pub fn parse(text: &str) -> Result<SideSetup, String> {
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
        let mut side = SideSetup {
            build: of_tree.join(",").parse()?,
            cylinders: Cylinders::Exact,
            d_arec: 4,
            cut_off: 0.0,
            precision: PrecisionChoice::F64,
        };
        for (name, value) in of_picture {
            let wrong = |expected: &str| format!("{name}: expected {expected}, found '{value}'");
            match name {
                "d-arec" => {
                    side.d_arec = value.parse().map_err(|_| wrong("a whole number"))?;
                }
                "cut-off" => {
                    let share = value.parse().ok().filter(|s| (0.0..=1.0).contains(s));
                    side.cut_off = share.ok_or_else(|| wrong("a number from 0 to 1"))?;
                }
                "precision" => {
                    let choice = PrecisionChoice::named(value);
                    side.precision = choice.ok_or_else(|| wrong("f32, f64 or auto"))?;
                }
                _ => side.cylinders = value.parse()?,
            }
        }
        Ok(side)
    }
}

impl Setup {
    /// The scene of one of its sides.
    pub fn scene(&self, side: &SideSetup) -> SceneRequest {
        SceneRequest {
            source: self.scene.clone(),
            cylinders: side.cylinders,
        }
    }

    /// The picture of one of its sides, seen by this camera unless the step has its own.
    pub fn render(&self, side: &SideSetup, camera: Camera, threads: usize) -> RenderSettings {
        let [width, height] = self.size;
        RenderSettings {
            width,
            height,
            d_arec: side.d_arec,
            cut_off: side.cut_off,
            precision: side.precision,
            threads,
            ..RenderSettings::for_camera(self.camera.unwrap_or(camera))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_of_tree_and_picture_stand_in_one_list() {
        let side = SideSetup::parse("method=sah-cut, d-max=12, d-arec=1, precision=f32").unwrap();
        assert_eq!(side.build, "method=sah-cut,d-max=12".parse().unwrap());
        assert_eq!((side.d_arec, side.precision), (1, PrecisionChoice::F32));
        assert_eq!(side.cylinders, Cylinders::Exact);
        let side = SideSetup::parse("cylinders=polygons:5,method=none,cut-off=0.1").unwrap();
        assert_eq!(side.cylinders, Cylinders::Polygons(5));
        assert_eq!((side.d_arec, side.cut_off), (4, 0.1));
        for wrong in [
            "",
            "d-arec=2",
            "method=none,d-arec=x",
            "method=none,precision=f16",
            "method=none,cut-off=2",
            "method=none,colour=1",
        ] {
            assert!(SideSetup::parse(wrong).is_err(), "{wrong}");
        }
    }
}
