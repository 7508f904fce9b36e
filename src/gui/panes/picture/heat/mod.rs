//! Heatmaps in the picture pane: [`choice`] is how the user wants them, [`look`] is what results from it,
//! [`menu`] and [`legend`] are the widgets above and below the picture. Which heatmap is shown is chosen
//! in the document.

mod choice;
mod export;
mod kept;
mod layer;
pub mod legend;
mod look;
pub mod menu;
mod order;

use crate::gui::document::comparing::{View, Which};
use crate::gui::document::picture_job::{PictureJob, Progress};
use crate::gui::document::{Current, Document};
use crate::gui::widgets::symbol::grouped;
use crate::jobs::{Stage, TimePixels};
use crate::measure::heat::{Heatmap, PIXEL_COUNTS_LIMIT, Source, heatmaps};
use crate::present::overlay::Range;
use choice::Choice;
pub use choice::next_heatmap;
use egui::{Color32, TextureId};
pub use layer::DIM;
use layer::Layer;
use look::{Look, LookKey, Values, ValuesKey};
use order::Order;
use std::sync::Arc;

/// The heatmaps over the picture, or over the pictures of two compared trees.
#[derive(Default)]
pub struct HeatView {
    choice: Choice,
    /// Of A and of B.
    layers: [Layer; 2],
    /// Of B less A.
    difference: Layer,
    /// The time of every pixel, of A and of B.
    timings: [PictureJob<TimePixels>; 2],
    /// What legend and keys are about.
    on: On,
    order: Order,
}

/// What the pane shows of two trees.
#[derive(Clone, Copy, PartialEq)]
enum On {
    /// The picture of one; there may be the other beside it.
    Picture(Which),
    Difference,
}

impl Default for On {
    fn default() -> Self {
        On::Picture(Which::A)
    }
}

impl HeatView {
    /// Brings what is on view up to date with choice and pictures. Until new colors are there, the last
    /// ones stay with their own legend, if they are of the same picture or of one that looks the same.
    pub fn update(&mut self, ctx: &egui::Context, doc: &Document) {
        let comparing = doc.other.is_some();
        self.on = match doc.comparing.view {
            View::Difference if comparing => On::Difference,
            _ => On::Picture(doc.which),
        };
        self.choice.differences = self.on == On::Difference;
        let both = doc.both();
        let keeps =
            |side: Option<&Current>, number| side.is_some_and(|current| current.looks_like(number));
        let [a, b] = both;
        let [of_a, of_b] = &mut self.layers;
        of_a.keep_if(|key| keeps(a, key.number));
        of_b.keep_if(|key| keeps(b, key.number));
        self.difference.keep_if(|key| {
            keeps(b, key.number) && key.minus.is_some_and(|number| keeps(a, number))
        });
        let Some((place, heatmap)) = chosen(doc) else {
            self.timings.iter_mut().for_each(PictureJob::drop_unneeded);
            self.layers = Default::default();
            self.difference = Layer::default();
            return;
        };
        let values = [Which::A, Which::B].map(|which| {
            let current = both[which as usize]?;
            let key = ValuesKey {
                number: current.number,
                minus: None,
                heatmap: place,
                rays: self.choice.rays(heatmap),
            };
            let values = self.values(which, key, heatmap, current, doc, ctx)?;
            Some((key, values))
        });
        match (self.on, values) {
            (On::Difference, [Some((a, of_a)), Some((b, of_b))]) => {
                let same = |v: &Values| (v.image.width, v.image.height);
                if same(&of_a) != same(&of_b) {
                    return;
                }
                let key = ValuesKey {
                    minus: Some(a.number),
                    ..b
                };
                let less = move || of_b.less(&of_a).expect("the sizes are equal");
                if let Some(values) = self.difference.values(key, ctx, less) {
                    let key = self.look_key(key, None);
                    self.difference.show(key, values, ctx);
                }
            }
            (On::Difference, _) => {}
            (On::Picture(_), values) => {
                let span = match &values {
                    [Some((_, a)), Some((_, b))] => span([a, b]),
                    _ => None,
                };
                for (which, values) in [Which::A, Which::B].into_iter().zip(values) {
                    if let Some((key, values)) = values {
                        let key = self.look_key(key, span);
                        self.layers[which as usize].show(key, values, ctx);
                    }
                }
            }
        }
    }

    /// The values of one picture, once they are there.
    fn values(
        &mut self,
        which: Which,
        key: ValuesKey,
        heatmap: &'static Heatmap,
        current: &Current,
        doc: &Document,
        ctx: &egui::Context,
    ) -> Option<Arc<Values>> {
        let layer = &mut self.layers[which as usize];
        if !matches!(heatmap.source, Source::Time) {
            self.timings[which as usize].drop_unneeded();
            let counts = Arc::clone(current.pixel_counts.as_ref()?);
            return layer.values(key, ctx, move || Values::of(heatmap, &counts, key.rays));
        }
        let counts = if is_too_large(current) {
            None
        } else {
            let shown = &current.shown;
            self.timings[which as usize].get(current, &doc.jobs, || TimePixels {
                picture: which as u64,
                scene: Arc::clone(&shown.scene),
                tree: Arc::clone(&shown.tree),
                render: shown.setup.render,
            })
        };
        let layer = &mut self.layers[which as usize];
        match counts {
            Some(counts) => layer.values(key, ctx, move || Values::of(heatmap, &counts, key.rays)),
            None => {
                layer.look = None;
                None
            }
        }
    }

    fn look_key(&self, values: ValuesKey, span: Option<Range>) -> LookKey {
        let range = self.choice.range(values.heatmap);
        let spanning = span.filter(|_| range == Range::Automatic);
        LookKey {
            values,
            scale: self.choice.scale,
            range: spanning.unwrap_or(range),
            spans_both: spanning.is_some(),
            colors: self.choice.colors(),
        }
    }

    /// What the legend is about.
    fn look(&self) -> Option<&Arc<Look>> {
        match self.on {
            On::Picture(which) => self.layers[which as usize].look.as_ref(),
            On::Difference => self.difference.look.as_ref(),
        }
    }

    /// Goes to a pixel later or earlier in the order of cost, as soon as the order is known.
    pub fn step_by_cost(&mut self, by: i64) {
        self.order.step(by);
    }

    /// Returns the pixel that keys or buttons asked for, once the order of cost is known.
    pub fn costly_pixel(&mut self, doc: &Document, ctx: &egui::Context) -> Option<[u32; 2]> {
        if !self.order.is_asked() {
            return None;
        }
        let current = doc.current.as_ref()?;
        let shown = self.chosen_look(doc).cloned();
        if let Some(look) = shown.filter(|look| look.key.values.number == current.number) {
            return self.order.pixel(&look, current.picked_pixel(), ctx);
        }
        // What was chosen a moment ago is worth waiting for; what is yet to be rendered is not.
        let is_on_its_way = current.pixel_counts.is_some() && !is_timed(doc);
        if chosen(doc).is_none() || !is_on_its_way {
            self.order.forget();
        }
        None
    }

    /// Returns the look of the heatmap and rays that are chosen; `None` while it is being made.
    fn chosen_look(&self, doc: &Document) -> Option<&Arc<Look>> {
        let (place, heatmap) = chosen(doc)?;
        let rays = self.choice.rays(heatmap);
        self.look().filter(|look| {
            let key = look.key.values;
            key.heatmap == place && key.rays == rays
        })
    }

    /// Whether a look is of an earlier picture, or of settings that have changed.
    fn is_old(key: ValuesKey, which: Which, doc: &Document) -> bool {
        let is_old = |which: Which, number: u64| {
            let is_previous = match &doc.other {
                Some(other) if which != doc.which => other.is_previous(doc.reload),
                _ => doc.is_previous(),
            };
            let current = doc.both()[which as usize];
            is_previous || current.is_none_or(|current| current.number != number)
        };
        match key.minus {
            None => is_old(which, key.number),
            Some(minus) => is_old(Which::A, minus) || is_old(Which::B, key.number),
        }
    }

    /// Switches between colors by the value and by its logarithm.
    pub fn turn_scale(&mut self) {
        self.choice.turn_scale();
    }

    /// Keeps the range on view from now on, or lets it follow the values again.
    pub fn toggle_lock(&mut self, doc: &Document) {
        let Some(place) = doc.heatmap else {
            return;
        };
        let range = match (self.choice.locked(place), self.range_on_view(doc)) {
            (Some(_), _) => None,
            (None, Some(range)) => Some(range),
            (None, None) => return,
        };
        self.choice.lock(place, range);
    }

    /// The ends of the color bar, if it is of the heatmap that was chosen.
    fn range_on_view(&self, doc: &Document) -> Option<[f64; 2]> {
        let look = self.chosen_look(doc)?;
        let scale = look.scale.as_ref()?;
        Some(choice::range_of(scale, look.heatmap()))
    }

    /// Returns colors to draw over a picture, and how; `None` while it is shown alone.
    pub fn texture(
        &mut self,
        which: Which,
        doc: &Document,
        ctx: &egui::Context,
    ) -> Option<(TextureId, Color32)> {
        let layer = match self.on {
            On::Picture(_) => &mut self.layers[which as usize],
            On::Difference => &mut self.difference,
        };
        let is_old = Self::is_old(layer.look.as_ref()?.key.values, which, doc);
        let tint = layer::tint(self.choice.opacity, is_old);
        Some((layer.texture(ctx)?, tint))
    }

    /// The values of a pixel in words, for the status line: of both trees where both are on view.
    pub fn value_text(&self, pixel: [u32; 2]) -> Option<String> {
        let look = self.look()?;
        let symbol = look.heatmap().symbol;
        Some(match (self.on, &self.layers) {
            (On::Difference, _) => format!("{symbol} B − A {}", look.value_text(pixel)),
            (_, [Layer { look: Some(a), .. }, Layer { look: Some(b), .. }]) => {
                let [a, b] = [a, b].map(|look| look.number_text(pixel).unwrap_or("–".to_owned()));
                format!("{symbol} A {a} · B {b} {}", look.heatmap().unit)
            }
            _ => format!("{symbol} {}", look.value_text(pixel)),
        })
    }

    /// The measurement of times whose standing matters now.
    fn timing(&mut self) -> &mut PictureJob<TimePixels> {
        let [a, b] = &mut self.timings;
        match self.on {
            On::Picture(Which::A) => a,
            On::Picture(Which::B) => b,
            On::Difference if a.ready().is_some() => b,
            On::Difference => a,
        }
    }

    /// Why there is nothing to show yet.
    fn note(&mut self, doc: &Document) -> String {
        let Some(current) = &doc.current else {
            return "Counting begins when there is a picture.".to_owned();
        };
        if let (On::Difference, [Some(a), Some(b)]) = (self.on, doc.both()) {
            let size = |side: &Current| (side.shown.picture.width, side.shown.picture.height);
            if size(a) != size(b) {
                return "No difference: the pictures have different sizes.".to_owned();
            }
        }
        if is_too_large(current) {
            let limit = grouped(PIXEL_COUNTS_LIMIT as usize);
            return format!("Only pictures of up to {limit} pixels are counted pixel by pixel.");
        }
        if is_timed(doc) {
            return match self.timing().progress() {
                Progress::Running(done) => format!("Timing every pixel: {:.0} %", done * 100.0),
                Progress::Ended(why) => format!("Not timed: {why}"),
                Progress::Waiting | Progress::Done if doc.stopped && !current.done => {
                    "Not timed: the picture was cancelled. Resume it first.".to_owned()
                }
                Progress::Waiting | Progress::Done => match doc.measuring() {
                    Some(what) => format!("Timing begins when the {what} has ended."),
                    None => "Timing begins when the picture is finished.".to_owned(),
                },
            };
        }
        if current.pixel_counts.is_some() {
            return match self.on {
                On::Picture(_) => "Coloring".to_owned(),
                On::Difference => "Counting the other tree".to_owned(),
            };
        }
        match &doc.work {
            Some(work) if work.stage == Stage::Counting => {
                let fraction = work.status().map_or(1.0, |status| status.fraction);
                format!("Counting: {:.0} %", fraction * 100.0)
            }
            Some(_) => "Counting begins when the picture is rendered.".to_owned(),
            None => "Not counted: the picture was cancelled. Resume it first.".to_owned(),
        }
    }
}

/// Returns the heatmap that the document shows, with its place in the registry.
fn chosen(doc: &Document) -> Option<(usize, &'static Heatmap)> {
    let place = doc.heatmap?;
    Some((place, &heatmaps()[place]))
}

/// Whether the times of pixels are chosen.
fn is_timed(doc: &Document) -> bool {
    chosen(doc).is_some_and(|(_, heatmap)| matches!(heatmap.source, Source::Time))
}

fn is_too_large(current: &Current) -> bool {
    let picture = &current.shown.picture;
    u64::from(picture.width) * u64::from(picture.height) > PIXEL_COUNTS_LIMIT
}

/// From the lowest to the highest value of two pictures; `None` where that is no range.
fn span(both: [&Values; 2]) -> Option<Range> {
    let [a, b] = both.map(|values| values.statistics);
    let (a, b) = (a?, b?);
    let (lo, hi) = (a.lowest.min(b.lowest), a.highest.max(b.highest));
    (lo < hi).then_some(Range::Fixed { lo, hi })
}
