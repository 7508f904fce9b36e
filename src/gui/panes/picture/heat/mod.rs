//! Heatmaps in the picture pane: [`choice`] is what the user chose, [`look`] what comes of it,
//! [`controls`] and [`legend`] are the widgets above and below the picture.

mod choice;
mod controls;
mod export;
mod kept;
mod layer;
mod legend;
mod look;

use crate::gui::document::comparing::{View, Which};
use crate::gui::document::picture_job::{PictureJob, Progress};
use crate::gui::document::tasks::Latest;
use crate::gui::document::{Current, Document};
use crate::gui::widgets::symbol::grouped;
use crate::jobs::{Stage, TimePixels};
use crate::measure::heat::{Heatmap, PIXEL_COUNTS_LIMIT, Source};
use crate::present::overlay::Range;
use choice::Choice;
use egui::{Color32, TextureId};
use layer::Layer;
use look::{Look, LookKey, Values, ValuesKey};
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
    orders: Latest<ValuesKey, Vec<u32>>,
    /// Steps down the order of expense that were asked for.
    steps: i64,
    ranked: Option<Ranked>,
    /// Height of the legend in points as last laid out.
    legend_height: f32,
    /// Whether the pane is too short for all of the legend.
    short: bool,
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

/// A pixel found by its rank.
struct Ranked {
    key: ValuesKey,
    pixel: [u32; 2],
    /// 0 for the most expensive.
    rank: usize,
    /// How many pixels have a value.
    of: usize,
}

impl HeatView {
    /// Brings what is on view up to date with choice and pictures. Until new colours are there, the
    /// last ones of the same picture stay, with their own legend.
    pub fn update(&mut self, ctx: &egui::Context, doc: &Document) {
        let comparing = doc.other.is_some();
        self.on = match doc.comparing.view {
            View::Difference if comparing => On::Difference,
            _ => On::Picture(doc.which),
        };
        self.choice.differences = self.on == On::Difference;
        let both = doc.both();
        let [a, b] = both.map(|side| side.map(|current| current.number));
        let [of_a, of_b] = &mut self.layers;
        of_a.keep_only(a, None);
        of_b.keep_only(b, None);
        self.difference.keep_only(b, a);
        let Some((place, heatmap)) = self.choice.heatmap() else {
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
                rays: self.choice.rays(),
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
        let range = self.choice.range();
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

    /// Picks the pixel that keys or buttons asked for, once the order of expense is known; whether
    /// it did.
    pub fn go(&mut self, ctx: &egui::Context, current: &mut Current) -> bool {
        if self.steps == 0 {
            return false;
        }
        let shown = self.look().cloned();
        let chosen = shown.filter(|look| {
            let key = look.key.values;
            self.choice.heatmap == Some(key.heatmap) && key.rays == self.choice.rays()
        });
        let Some(look) = chosen else {
            // What was chosen a moment ago is worth waiting for; what is still to be traced, not.
            let is_chosen = self.choice.heatmap.is_some();
            if !is_chosen || current.pixel_counts.is_none() || self.is_timed() {
                self.steps = 0;
            }
            return false;
        };
        let key = look.key.values;
        let values = Arc::clone(&look.values);
        let Some(order) = self.orders.get(&key, ctx, move || values.by_expense()) else {
            return false;
        };
        let steps = std::mem::take(&mut self.steps);
        // From a pixel that was not found by its rank, the way begins at the top.
        let rank = match self.rank_of_picked(current) {
            Some(ranked) => ranked.rank as i64 + steps,
            None => steps - 1,
        };
        let Some(last) = order.len().checked_sub(1) else {
            return false;
        };
        let rank = rank.clamp(0, last as i64) as usize;
        let (width, at) = (look.values.image.width, order[rank]);
        let pixel = [at % width, at / width];
        self.ranked = Some(Ranked {
            key,
            pixel,
            rank,
            of: order.len(),
        });
        current.pick(pixel);
        true
    }

    /// Whether the times of pixels were chosen.
    fn is_timed(&self) -> bool {
        self.choice
            .heatmap()
            .is_some_and(|(_, heatmap)| matches!(heatmap.source, Source::Time))
    }

    /// The rank of the picked pixel, if it was found by it.
    fn rank_of_picked(&self, current: &Current) -> Option<&Ranked> {
        let picked = current.picked_pixel()?;
        let key = self.look()?.key.values;
        self.ranked
            .as_ref()
            .filter(|ranked| ranked.pixel == picked && ranked.key == key)
    }

    /// The heatmap on view, by its place in the registry; `None` for the picture alone.
    pub fn shown(&self) -> Option<usize> {
        self.choice.heatmap
    }

    /// Takes over which heatmap the document shows.
    pub fn follow(&mut self, doc: &Document) {
        self.choice.heatmap = doc.heatmap;
    }

    /// Shows the next heatmap or the previous one; the picture is one of the circle.
    pub fn turn(&mut self, forward: bool) {
        self.choice.turn(forward);
    }

    /// Switches between colors by the value and by its logarithm.
    pub fn turn_scale(&mut self) {
        self.choice.turn_scale();
    }

    /// Picks a pixel later or earlier in the order of cost, as soon as the order is known.
    pub fn step_by_cost(&mut self, by: i64) {
        self.steps += by;
    }

    /// Keeps the range on view from now on, or lets it follow the values again.
    pub fn toggle_lock(&mut self) {
        let range = match (self.choice.locked(), self.range_on_view()) {
            (Some(_), _) => None,
            (None, Some(range)) => Some(range),
            (None, None) => return,
        };
        self.choice.lock(range);
    }

    /// The ends of the colour bar, if it is of the heatmap that was chosen.
    fn range_on_view(&self) -> Option<[f64; 2]> {
        let look = self.look()?;
        let chosen = self.choice.heatmap == Some(look.key.values.heatmap);
        let scale = look.scale.as_ref().filter(|_| chosen)?;
        Some(choice::range_of(scale, look.heatmap()))
    }

    /// Whether the picture is shown alone.
    pub fn is_picture(&self) -> bool {
        self.choice.heatmap.is_none()
    }

    /// Shows the picture alone.
    pub fn show_picture(&mut self) {
        self.choice.heatmap = None;
    }

    /// Colours to draw over a picture, and how; `None` while it is to be seen alone.
    pub fn texture(&mut self, which: Which, ctx: &egui::Context) -> Option<(TextureId, Color32)> {
        let layer = match self.on {
            On::Picture(_) => &mut self.layers[which as usize],
            On::Difference => &mut self.difference,
        };
        Some((layer.texture(ctx)?, layer::tint(self.choice.opacity)))
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

    /// The pass whose standing matters now.
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
            return "counting … begins when there is a picture".to_owned();
        };
        if let (On::Difference, [Some(a), Some(b)]) = (self.on, doc.both()) {
            let size = |side: &Current| (side.shown.picture.width, side.shown.picture.height);
            if size(a) != size(b) {
                return "No difference: the pictures have another size.".to_owned();
            }
        }
        if is_too_large(current) {
            let limit = grouped(PIXEL_COUNTS_LIMIT as usize);
            return format!("Only pictures of up to {limit} pixels are counted pixel by pixel.");
        }
        if self.is_timed() {
            return match self.timing().progress() {
                Progress::Running(done) => {
                    format!("timing every pixel … {:.0} %", done * 100.0)
                }
                Progress::Ended(why) => format!("Not timed: {why}"),
                Progress::Waiting | Progress::Done if doc.stopped && !current.done => {
                    "Not timed: the picture was cancelled. Resume it first.".to_owned()
                }
                Progress::Waiting | Progress::Done => match doc.measuring() {
                    Some(what) => format!("timing … begins when the {what} has ended"),
                    None => "timing … begins when the picture is finished".to_owned(),
                },
            };
        }
        if current.pixel_counts.is_some() {
            return match self.on {
                On::Picture(_) => "colouring …".to_owned(),
                On::Difference => "counting the other tree …".to_owned(),
            };
        }
        match &doc.work {
            Some(work) if work.stage == Stage::Counting => {
                let fraction = work.status().map_or(1.0, |status| status.fraction);
                format!("counting … {:.0} %", fraction * 100.0)
            }
            Some(_) => "counting … begins when the picture is traced".to_owned(),
            None => "Not counted: the picture was cancelled. Resume it first.".to_owned(),
        }
    }
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
