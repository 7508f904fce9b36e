//! Heatmaps in the picture pane: [`choice`] is what the user chose, [`look`] what comes of it,
//! [`controls`] and [`legend`] are the widgets above and below the picture.

mod choice;
mod controls;
mod legend;
mod look;
mod timing;

use super::background::Latest;
use super::shortcuts::Action;
use super::state::{Current, State};
use super::symbol::grouped;
use crate::measure::heat::Source;
use crate::worker::{PIXEL_COUNTS_LIMIT, Stage};
use choice::Choice;
use egui::{Color32, TextureHandle, TextureId, TextureOptions};
use look::{Look, LookKey, Values, ValuesKey};
use std::sync::Arc;
use timing::{Standing, Timing};

/// The heatmap over the picture.
#[derive(Default)]
pub struct HeatView {
    choice: Choice,
    values: Latest<ValuesKey, Values>,
    looks: Latest<LookKey, Look>,
    orders: Latest<ValuesKey, Vec<u32>>,
    timing: Timing,
    /// What is on view; `None` for the picture alone, and while there is nothing to show yet.
    look: Option<Arc<Look>>,
    /// Holds the colours of the look with this key.
    texture: Option<(LookKey, TextureHandle)>,
    /// Steps down the order of expense that were asked for.
    steps: i64,
    ranked: Option<Ranked>,
    /// Height of the legend in points as last laid out.
    legend_height: f32,
    /// Whether the pane is too short for all of the legend.
    short: bool,
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
    /// Brings what is on view up to date with choice and picture. Until new colours are there, the
    /// last ones of the same picture stay, with their own legend.
    pub fn update(&mut self, ctx: &egui::Context, state: &State) {
        let number = state.current.as_ref().map(|current| current.number);
        let shown = self.look.as_ref().map(|look| look.key.values.number);
        if shown != number {
            self.look = None;
        }
        let Some((_, heatmap)) = self.choice.heatmap() else {
            self.timing.give_up();
            self.look = None;
            return;
        };
        let Some(current) = &state.current else {
            return;
        };
        let Some(key) = self.chosen(current) else {
            return;
        };
        let values = if self.is_timed() {
            let times = if is_too_large(current) {
                None
            } else {
                self.timing.get(heatmap, state, ctx)
            };
            if times.is_none() {
                self.look = None;
            }
            times
        } else {
            self.timing.give_up();
            current.pixel_counts.as_ref().and_then(|counts| {
                let counts = Arc::clone(counts);
                self.values
                    .get(&key, ctx, move || Values::of(heatmap, &counts, key.rays))
            })
        };
        let Some(values) = values else {
            return;
        };
        let key = LookKey {
            values: key,
            scale: self.choice.scale,
            range: self.choice.range(),
            colors: self.choice.colors,
        };
        if let Some(look) = self.looks.get(&key, ctx, move || Look::of(key, values)) {
            self.look = Some(look);
        }
    }

    /// Picks the pixel that keys or buttons asked for, once the order of expense is known; whether
    /// it did.
    pub fn go(&mut self, ctx: &egui::Context, current: &mut Current) -> bool {
        if self.steps == 0 {
            return false;
        }
        let chosen = self.chosen(current);
        let shown = self.look.as_ref();
        let Some(look) = shown.filter(|look| Some(look.key.values) == chosen) else {
            // What was chosen a moment ago is worth waiting for; what is still to be traced, not.
            if chosen.is_none() || current.pixel_counts.is_none() || self.is_timed() {
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

    /// The values that were chosen; `None` for the picture alone.
    fn chosen(&self, current: &Current) -> Option<ValuesKey> {
        Some(ValuesKey {
            number: current.number,
            heatmap: self.choice.heatmap?,
            rays: self.choice.rays(),
        })
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
        let key = self.look.as_ref()?.key.values;
        self.ranked
            .as_ref()
            .filter(|ranked| ranked.pixel == picked && ranked.key == key)
    }

    /// Shows a heatmap, by its place in the registry; `None` for the picture alone.
    pub fn show(&mut self, heatmap: Option<usize>) {
        self.choice.heatmap = heatmap;
    }

    /// Does what a key asks for.
    pub fn act(&mut self, action: Action) {
        match action {
            Action::NextHeatmap => self.choice.turn(true),
            Action::PreviousHeatmap => self.choice.turn(false),
            Action::LogScale => self.choice.turn_scale(),
            Action::LockRange => self.toggle_lock(),
            Action::MoreExpensive => self.steps -= 1,
            Action::LessExpensive => self.steps += 1,
            _ => {}
        }
    }

    /// Keeps the range on view from now on, or lets it follow the values again.
    fn toggle_lock(&mut self) {
        let range = match (self.choice.locked(), self.range_on_view()) {
            (Some(_), _) => None,
            (None, Some(range)) => Some(range),
            (None, None) => return,
        };
        self.choice.lock(range);
    }

    /// The ends of the colour bar, if it is of the heatmap that was chosen.
    fn range_on_view(&self) -> Option<[f64; 2]> {
        let look = self.look.as_ref()?;
        let chosen = self.choice.heatmap == Some(look.key.values.heatmap);
        let scale = look.scale.as_ref().filter(|_| chosen)?;
        Some(choice::range_of(scale, look.heatmap()))
    }

    /// Frees the processor for the worker's own timing.
    pub fn make_way(&mut self, state: &State) {
        self.timing.make_way(state);
    }

    /// Colours to draw over the picture, and how: `None` while the picture is to be seen alone.
    pub fn texture(&mut self, ctx: &egui::Context) -> Option<(TextureId, Color32)> {
        let look = self.look.as_ref()?;
        let fits = |texture: &TextureHandle| texture.size() == look.pixels.size;
        match &mut self.texture {
            Some((key, _)) if *key == look.key => {}
            Some((key, texture)) if fits(texture) => {
                texture.set(Arc::clone(&look.pixels), TextureOptions::NEAREST);
                *key = look.key;
            }
            texture => {
                let pixels = Arc::clone(&look.pixels);
                let handle = ctx.load_texture("heatmap", pixels, TextureOptions::NEAREST);
                *texture = Some((look.key, handle));
            }
        }
        let (_, texture) = self.texture.as_ref()?;
        let tint = Color32::WHITE.gamma_multiply(self.choice.opacity);
        Some((texture.id(), tint))
    }

    /// The value of a pixel in words, for the status line.
    pub fn value_text(&self, pixel: [u32; 2]) -> Option<String> {
        let look = self.look.as_ref()?;
        let symbol = look.heatmap().symbol;
        Some(format!("{symbol} {}", look.value_text(pixel)))
    }

    /// Why there is nothing to show yet.
    fn note(&self, state: &State) -> String {
        let Some(current) = &state.current else {
            return "counting … begins when there is a picture".to_owned();
        };
        if is_too_large(current) {
            let limit = grouped(PIXEL_COUNTS_LIMIT as usize);
            return format!("Only pictures of up to {limit} pixels are counted pixel by pixel.");
        }
        if self.is_timed() {
            return match self.timing.standing() {
                Standing::Running(done) => {
                    format!("timing every pixel … {:.0} %", done * 100.0)
                }
                Standing::Ended(why) => format!("Not timed: {why}"),
                Standing::Waiting if state.stopped && !current.done => {
                    "Not timed: the picture was cancelled. Resume it first.".to_owned()
                }
                Standing::Waiting => "timing … begins when the picture is finished".to_owned(),
            };
        }
        if current.pixel_counts.is_some() {
            return "colouring …".to_owned();
        }
        match &state.work {
            Some((Stage::Counting, progress)) => {
                format!("counting … {:.0} %", progress.fraction() * 100.0)
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
