//! All panes. A pane is one folder here and one line in [`PANES`].

mod accuracy;
mod build;
mod comparison;
mod cost;
mod figures;
mod histograms;
mod icicle;
mod lesson;
mod measures;
mod notes;
mod outline;
mod paper;
mod parameters;
mod picture;
mod ranking;
mod ray;
mod rays;
mod scene;
mod settings;
mod sweep;
mod time;
mod tune;
mod verification;
mod view3d;

use super::pane::Entry;

/// The panes, in the order of the bottom strip and of the list of shortcuts.
pub static PANES: &[Entry] = &[
    Entry::of::<picture::PicturePane>(),
    Entry::of::<view3d::View3d>(),
    Entry::of::<figures::FiguresPane>(),
    Entry::of::<comparison::ComparisonPane>(),
    Entry::of::<ray::RayPane>(),
    Entry::of::<rays::RaysPane>(),
    Entry::of::<lesson::LessonPane>(),
    Entry::of::<outline::Outline>(),
    Entry::of::<histograms::Histograms>(),
    Entry::of::<icicle::Icicle>(),
    Entry::of::<cost::CostPane>(),
    Entry::of::<build::BuildPane>(),
    Entry::of::<accuracy::AccuracyPane>(),
    Entry::of::<time::TimePane>(),
    Entry::of::<sweep::SweepPane>(),
    Entry::of::<measures::MeasuresPane>(),
    Entry::of::<tune::TunePane>(),
    Entry::of::<ranking::RankingPane>(),
    Entry::of::<parameters::ParametersPane>(),
    Entry::of::<scene::ScenePane>(),
    Entry::of::<verification::VerificationPane>(),
    Entry::of::<paper::PaperPane>(),
    Entry::of::<settings::SettingsPane>(),
    Entry::of::<notes::NotesPane>(),
];
