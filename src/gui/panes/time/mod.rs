//! Where the time of the picture goes: the terms of equation (1) as a stacked bar with a table, for the
//! whole picture, a region of it or the picked pixel.

mod bar;
mod study;

use crate::gui::action::{actions, tip};
use crate::gui::document::picture_job::{PictureJob, Progress};
use crate::gui::document::{Current, Document};
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::widgets::common::no_picture;
use crate::gui::widgets::study_bar;
use crate::gui::widgets::symbol::grouped;
use crate::jobs::{CountTerms, Scheduler};
use crate::measure::heat::PIXEL_COUNTS_LIMIT;
use crate::measure::model::{Part, PictureTerms, Region, TermTimes};
use crate::present::number::Digits;
use std::sync::Arc;
use study::{Found, Modelling};

/// Which part of the picture is asked about.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum Extent {
    #[default]
    Picture,
    Region,
    Pixel,
}

impl Extent {
    const ALL: [Extent; 3] = [Extent::Picture, Extent::Region, Extent::Pixel];

    const fn name(self) -> &'static str {
        match self {
            Extent::Picture => "whole picture",
            Extent::Region => "region",
            Extent::Pixel => "picked pixel",
        }
    }
}

/// Which times of the terms are used.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum Source {
    #[default]
    Regression,
    InPlace,
}

impl Source {
    const ALL: [Source; 2] = [Source::Regression, Source::InPlace];

    const fn name(self) -> &'static str {
        match self {
            Source::Regression => "by regression",
            Source::InPlace => "in place",
        }
    }

    const fn about(self) -> &'static str {
        match self {
            Source::Regression => {
                "The times that best explain T_TR of a set of trees: nonnegative least squares of \
                 the relative errors."
            }
            Source::InPlace => {
                "The tests of the picture are repeated, and its rays traverse the tree without tests: \
                 always by the scalar kernel in f64. Without the constant."
            }
        }
    }

    /// What the terms take; `None` until it is known.
    fn times(self, found: &Found) -> Option<TermTimes> {
        match self {
            Source::Regression => found.fitted(),
            Source::InPlace => found.in_place.as_ref().map(TermTimes::of_in_place),
        }
    }
}

#[derive(Default)]
pub struct TimePane {
    modelling: Modelling,
    extent: Extent,
    source: Source,
    terms: PictureJob<CountTerms>,
}

impl Pane for TimePane {
    const ID: &'static str = "time";
    const TITLE: &'static str = "Time by term";
    const ALIASES: &'static [&'static str] = &["Time"];
    const ABOUT: &'static str =
        "Where the rendering time goes: nodes, hits and misses, by equation (1).";
    const REVEALS: &'static [Fact] = &[Fact::AllCounters];
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "time.run" Here NONE [Enter] "Measure what nodes and tests take; Esc ends it" => |pane, cx| pane.modelling.start(cx.doc);
        "time.next-extent" Here NONE [W] "Show the time of the whole picture, the marked region or the picked pixel" => |pane, _| pane.extent = Extent::ALL[(pane.extent as usize + 1) % Extent::ALL.len()];
        "time.next-times" Here NONE [C] "Show times by regression or in place" => |pane, _| pane.source = Source::ALL[(pane.source as usize + 1) % Source::ALL.len()];
    };

    fn update(&mut self, _: &mut Cx<'_>) {
        self.modelling.receive();
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        ui.horizontal_wrapped(|ui| self.toolbar(ui, doc));
        let Some(current) = &doc.current else {
            no_picture(ui, doc);
            return;
        };
        let found = self.modelling.study.found().cloned();
        let Some(found) = found.filter(|found| found.is_of(current)) else {
            ui.weak(
                "Where does the time of this picture go? The time per node and per test is measured once \
                 per scene, kernel and precision: equation (1).",
            );
            return;
        };
        let Some(times) = self.source.times(&found) else {
            ui.weak(match self.source {
                Source::Regression => format!(
                    "{} of {} trees are timed. Times in place are known earlier.",
                    found.observations.len(),
                    found.trees
                ),
                Source::InPlace => "Timing in place…".to_owned(),
            });
            return;
        };
        let Some(terms) = self.terms(ui, current, &doc.jobs) else {
            return;
        };
        let region = match self.region(current, doc.region) {
            Ok(region) => region,
            Err(why) => {
                ui.weak(why);
                return;
            }
        };
        let parts = times.parts(&terms.sum(region));
        let measured = current
            .shown
            .measurement
            .rendering
            .map(|r| r.cpu.as_secs_f64());
        let measured = measured.filter(|_| region.is_none());
        ui.add(egui::Label::new(self.about(&parts, measured, &found, region)).wrap());
        egui::ScrollArea::both()
            .auto_shrink(false)
            .show(ui, |ui| bar::show(ui, &parts, measured));
    }
}

impl TimePane {
    fn toolbar(&mut self, ui: &mut egui::Ui, doc: &Document) {
        let words = [
            "Cancel timing",
            "Cancel the measurement; what was measured stays.",
            "waiting",
        ];
        if !study_bar::running(ui, &mut self.modelling.study, words) {
            let measure = ui.add_enabled(
                self.modelling.may_start(doc),
                egui::Button::new("Measure times"),
            );
            let about = "Measure what a node, a hit and a miss take in this scene, in place and by \
                         regression over a set of trees, in the background.";
            if measure
                .on_hover_text(tip(about, "time.run"))
                .on_disabled_hover_text("Needs a finished picture of a scene with objects.")
                .clicked()
            {
                self.modelling.start(doc);
            }
            let cancelled = "cancelled: what was measured stays";
            study_bar::ended(ui, &self.modelling.study, cancelled);
        }
        ui.separator();
        for extent in Extent::ALL {
            let about = match extent {
                Extent::Picture => "All rays of the picture.",
                Extent::Region => "Rays of the region: Shift+drag one in the picture.",
                Extent::Pixel => "Rays of the picked pixel: click one in the picture.",
            };
            ui.selectable_value(&mut self.extent, extent, extent.name())
                .on_hover_text(tip(about, "time.next-extent"));
        }
        ui.separator();
        for source in Source::ALL {
            ui.selectable_value(&mut self.source, source, source.name())
                .on_hover_text(tip(source.about(), "time.next-times"));
        }
    }

    /// The counts of every pixel; says how they stand until they are there.
    fn terms(
        &mut self,
        ui: &mut egui::Ui,
        current: &Current,
        jobs: &Scheduler,
    ) -> Option<Arc<PictureTerms>> {
        let shown = &current.shown;
        let render = shown.setup.render;
        if u64::from(render.width) * u64::from(render.height) > PIXEL_COUNTS_LIMIT {
            let limit = grouped(PIXEL_COUNTS_LIMIT as usize);
            ui.weak(format!(
                "Tests are only counted in pictures of up to {limit} pixels."
            ));
            return None;
        }
        let terms = self.terms.get(current, jobs, || CountTerms {
            scene: Arc::clone(&shown.scene),
            tree: Arc::clone(&shown.tree),
            render,
        });
        if terms.is_none() {
            ui.weak(match self.terms.progress() {
                Progress::Running(done) => {
                    format!("Counting tests… {}", Digits::Three.percent(done))
                }
                Progress::Ended(why) => format!("Tests were not counted: {why}"),
                Progress::Waiting | Progress::Done => {
                    "Tests are counted when nothing else is running.".into()
                }
            });
        }
        terms
    }

    /// The pixels that are asked about; `None` is all of them.
    ///
    /// # Errors
    /// None are chosen, in words.
    fn region(&self, current: &Current, region: Option<Region>) -> Result<Option<Region>, &str> {
        match self.extent {
            Extent::Picture => Ok(None),
            Extent::Region => match region {
                Some(region) => Ok(Some(region)),
                None => Err("No region: Shift+drag one in the picture."),
            },
            Extent::Pixel => match current.picked_pixel() {
                Some([x, y]) => Ok(Some(Region {
                    x,
                    y,
                    width: 1,
                    height: 1,
                })),
                None => Err("No pixel is picked: click one in the picture."),
            },
        }
    }

    /// What is predicted, beside what was measured.
    fn about(
        &self,
        parts: &[Part],
        measured: Option<f64>,
        found: &Found,
        region: Option<Region>,
    ) -> String {
        let predicted: f64 = parts.iter().map(Part::seconds).sum();
        let of = match region {
            None => "Whole picture".to_owned(),
            Some(Region {
                x,
                y,
                width: 1,
                height: 1,
            }) => format!("Pixel {x}, {y}"),
            Some(r) => format!(
                "Region of {} × {} pixels from {}, {}",
                r.width, r.height, r.x, r.y
            ),
        };
        let mut text = format!("{of}: {} predicted", Digits::Four.seconds(predicted));
        if let Some(measured) = measured {
            text += &format!(
                ", {} measured (T_TR), {}",
                Digits::Four.seconds(measured),
                Digits::Three.signed_percent(predicted / measured - 1.0)
            );
        }
        match (self.source, found.worst(), &found.fit) {
            (Source::Regression, Some(worst), Some(fit)) => {
                text += &format!(
                    " · R² {:.4}, T_TR of trees left out within {}",
                    fit.r_squared,
                    Digits::Three.percent(worst)
                );
            }
            _ => text += " · without const, which is not timed in place",
        }
        text
    }
}
