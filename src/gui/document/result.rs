//! A picture with everything that belongs to it: tree, figures, counts, and what is selected in it.

use super::picked::{Picked, Wish};
use super::selection::Selection;
use super::tiles::Tiles;
use crate::jobs::{Shown, Update};
use crate::measure::heat::PixelCounts;
use crate::setup::Setup;
use crate::trace::{Picture, Step};
use std::sync::Arc;

/// A picture with everything that belongs to it.
pub struct Current {
    /// Number of the request that it answers; no other picture has it.
    pub number: u64,
    pub shown: Shown,
    /// Whether the figures are final.
    pub complete: bool,
    /// Whether nothing more will come.
    pub done: bool,
    /// Number of the newest sample in the picture.
    pub sample: u32,
    /// The tiles added to the picture.
    tiles: Tiles,
    /// A finished picture that this one will equal; it stays on view until this one is done.
    held: Option<OnView>,
    /// The pixel whose rays are to be followed, until they are.
    pub wish: Option<Wish>,
    pub picked: Option<Picked>,
    pub selection: Selection,
    /// What every pixel's rays did, once they were counted.
    pub pixel_counts: Option<Arc<PixelCounts>>,
}

/// A picture on view.
#[derive(Clone)]
pub struct OnView {
    /// The number of the request that the picture answers.
    pub number: u64,
    pub picture: Arc<Picture>,
}

impl Current {
    /// Whether the picture is finished, of a scene with objects: what most studies need.
    pub fn is_of_objects(&self) -> bool {
        self.done && !self.shown.scene.objects().is_empty()
    }

    /// A new picture in the place of the one before: what was picked and selected stays so where
    /// it means the same.
    pub fn new(number: u64, shown: Shown, before: Option<&Current>) -> Self {
        let wish = before.and_then(|before| before.kept_pixel(&shown));
        // What is selected stays so in another picture of the same tree.
        let selection = before
            .filter(|before| Arc::ptr_eq(&before.shown.tree, &shown.tree))
            .map_or_else(Selection::default, |before| before.selection);
        let held = before
            .filter(|before| before.promises(&shown))
            .map(Current::on_view);
        Current {
            number,
            sample: shown.sample,
            shown,
            complete: false,
            done: false,
            tiles: Tiles::default(),
            held,
            wish,
            picked: None,
            selection,
            pixel_counts: None,
        }
    }

    /// Whether a finished picture is on view that a new one will equal.
    fn promises(&self, shown: &Shown) -> bool {
        (self.done || self.held.is_some())
            && Arc::ptr_eq(&self.shown.scene, &shown.scene)
            && !shown.setup.alters_picture(&self.shown.setup)
    }

    /// Returns the picture to be shown: a finished one as long as this one is being rendered and will
    /// equal it, so that nothing flickers when only the tree changes.
    pub fn on_view(&self) -> OnView {
        let own = || OnView {
            number: self.number,
            picture: Arc::clone(&self.shown.picture),
        };
        self.held.clone().filter(|_| !self.done).unwrap_or_else(own)
    }

    /// Whether a picture of this setup, with its file read so often, will look different. Moves of the
    /// camera do not count: they follow the mouse, and new pictures come at once.
    pub(super) fn will_differ(&self, wanted: &Setup, reload: u64) -> bool {
        let shown = &self.shown;
        if shown.reload != reload {
            return true;
        }
        if shown.setup == *wanted {
            return false;
        }
        let mut wanted = wanted.clone();
        wanted.render.camera = shown.setup.render.camera;
        wanted.alters_picture(&shown.setup)
    }

    /// Whether an earlier picture is on view, which this one will equal.
    pub fn is_held(&self) -> bool {
        self.held.is_some() && !self.done
    }

    /// Whether the picture of a request is this one, or one that this one will equal.
    pub fn looks_like(&self, number: u64) -> bool {
        self.number == number || self.held.as_ref().is_some_and(|held| held.number == number)
    }

    /// Returns the tiles added to the picture.
    pub fn tiles(&self) -> &Tiles {
        &self.tiles
    }

    /// A picked pixel stays picked in a new picture of the same scene and size, and so does its ray.
    fn kept_pixel(&self, shown: &Shown) -> Option<Wish> {
        let same = Arc::ptr_eq(&self.shown.scene, &shown.scene)
            && self.shown.picture.width == shown.picture.width
            && self.shown.picture.height == shown.picture.height;
        let picked = self.picked.as_ref().map(|picked| Wish {
            pixel: picked.pixel,
            ray: picked.ray,
        });
        self.wish.or(picked).filter(|_| same)
    }

    /// The settings of what is shown, in one line: those that the paper gives, and all others that
    /// are not at their defaults.
    pub fn settings_text(&self) -> String {
        /// Settings that always have their place.
        const GIVEN: [&str; 5] = ["method", "d-max", "n-oilf", "d-arec", "resolution"];
        let Shown {
            setup,
            scene,
            measurement: m,
            ..
        } = &self.shown;
        let mut text = format!(
            "{} · {} · depth {} · leaf size {} · bounces {} · {} × {} pixels",
            scene.name(),
            m.build.method.name,
            m.depth_in_words(),
            m.build.n_oilf,
            m.render.d_arec,
            m.render.width,
            m.render.height,
        );
        let others = setup.differences().filter(|s| !GIVEN.contains(&s.name));
        for setting in others {
            text += &format!(" · {} {}", setting.word(), setting.text(setup));
        }
        text
    }
}

impl Current {
    pub fn take(&mut self, update: Update) {
        match update {
            Update::Tile {
                tile,
                sample,
                colors,
            } => {
                Arc::make_mut(&mut self.shown.picture).add_tile(&tile, sample, &colors);
                self.sample = self.sample.max(sample);
                self.tiles.push(tile);
            }
            Update::Measured {
                measurement,
                complete,
            } => {
                self.shown.measurement = *measurement;
                self.complete = complete;
            }
            Update::PixelCounts(counts) => self.pixel_counts = Some(counts),
            Update::Stage(_) | Update::Shown(_) => {}
        }
    }
}

impl Current {
    /// Asks for the rays of a pixel; one outside the picture picks none.
    pub fn pick(&mut self, [x, y]: [u32; 2]) {
        let inside = x < self.shown.setup.render.width && y < self.shown.setup.render.height;
        self.wish = inside.then_some(Wish {
            pixel: [x, y],
            ray: 0,
        });
    }

    /// Follows no pixel's rays any more.
    pub fn unpick(&mut self) {
        (self.wish, self.picked) = (None, None);
    }

    /// The pixel that is picked, be its rays followed yet or not.
    pub fn picked_pixel(&self) -> Option<[u32; 2]> {
        let wished = self.wish.map(|wish| wish.pixel);
        wished.or(self.picked.as_ref().map(|picked| picked.pixel))
    }

    /// Selects a ray, at the beginning of its walk.
    pub fn select_ray(&mut self, ray: usize) {
        if let Some(picked) = &mut self.picked
            && ray < picked.record.rays.len()
        {
            picked.ray = ray;
            self.go_to_step(0);
        }
    }

    /// Goes to a step of the walk, and selects its node.
    pub fn go_to_step(&mut self, step: usize) {
        if let Some(picked) = &mut self.picked {
            picked.step = step.min(picked.path().steps.len().saturating_sub(1));
            self.selection.node = picked.current().map(Step::node);
        }
    }
}
