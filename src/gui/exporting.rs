//! What is shown, as files: the Export menu, the question where to, and the work in the background.

use super::heat::HeatView;
use super::layout::Pane;
use super::save_as::{Answer, SaveAs};
use super::shortcuts::{Action, choose, text};
use super::state::{Current, Failure, State};
use super::view3d::View3d;
use crate::files;
use crate::jobs::{self, End, Handle, MakeBytes};
use crate::present::export::{LEAF_WRITERS, LeafCells, encoded, write_page};
use crate::present::report::{Report, WRITERS};
use crate::scene::SceneSource;
use image::ImageFormat;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

/// What can be exported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Export {
    Picture,
    Heatmap,
    View3d,
    Figures,
    Leaves,
    Page,
}

/// Makes the bytes of a file of this extension.
type Make = Box<dyn FnOnce(&str) -> Result<Vec<u8>, String> + Send>;

impl Export {
    pub const ALL: [Export; 6] = [
        Export::Picture,
        Export::Heatmap,
        Export::View3d,
        Export::Figures,
        Export::Leaves,
        Export::Page,
    ];

    /// The one that an action asks for.
    pub fn of(action: Action) -> Option<Export> {
        Export::ALL.into_iter().find(|e| e.action() == action)
    }

    const fn action(self) -> Action {
        match self {
            Export::Picture => Action::ExportPicture,
            Export::Heatmap => Action::ExportHeatmap,
            Export::View3d => Action::ExportView3d,
            Export::Figures => Action::ExportFigures,
            Export::Leaves => Action::ExportLeaves,
            Export::Page => Action::ExportPage,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Export::Picture => "Picture",
            Export::Heatmap => "Heatmap with its legend",
            Export::View3d => "3D view",
            Export::Figures => "Figures",
            Export::Leaves => "Leaf boxes",
            Export::Page => "Report",
        }
    }

    const fn about(self) -> &'static str {
        match self {
            Export::Picture => "The picture as far as it is traced: PNG, or EXR with linear values",
            Export::Heatmap => "The heatmap on view: PNG with its legend, or EXR with its values",
            Export::View3d => "The 3D view as it is on the screen, with its legend",
            Export::Figures => {
                "Δ, Λ and all of Tables 1 to 3; of A and B with ratios where they may be compared"
            }
            Export::Leaves => "The leaves that the 3D view's filters let through, as boxes",
            Export::Page => "One HTML file: pictures, tables, settings, notes, machine",
        }
    }

    /// What is added to the scene's name.
    const fn suffix(self) -> &'static str {
        match self {
            Export::Picture => "",
            Export::Heatmap => "-heatmap",
            Export::View3d => "-3d",
            Export::Figures => "-figures",
            Export::Leaves => "-leaves",
            Export::Page => "-report",
        }
    }

    /// File name extensions; the first is the default.
    fn extensions(self) -> Vec<&'static str> {
        match self {
            Export::Picture | Export::Heatmap => vec!["png", "exr"],
            Export::View3d => vec!["png"],
            Export::Figures => WRITERS.iter().map(|writer| writer.extension).collect(),
            Export::Leaves => LEAF_WRITERS.iter().map(|writer| writer.extension).collect(),
            Export::Page => vec!["html"],
        }
    }
}

/// Exports that are asked for or under way.
#[derive(Default)]
pub struct Exports {
    asking: Option<SaveAs<Export>>,
    /// The 3D view is taken from the screen once the question is gone from it: frames to go.
    taking: Option<(PathBuf, u8)>,
    /// A picture of the whole window that was requested, for this part of it.
    screen: Option<(PathBuf, egui::Rect, Receiver<Arc<egui::ColorImage>>)>,
    running: Vec<(PathBuf, Handle<jobs::Export>)>,
    /// Where the last file went.
    folder: Option<PathBuf>,
}

/// What exports are made of.
pub struct Shown<'a> {
    pub state: &'a mut State,
    pub heat: &'a HeatView,
    pub view3d: &'a View3d,
}

impl Exports {
    /// Asks where to write; says so where there is nothing to.
    pub fn ask(&mut self, export: Export, shown: &mut Shown<'_>, ctx: &egui::Context) {
        if let Err(why) = make(export, shown, ctx) {
            let what = format!("{} cannot be exported", export.name());
            shown.state.failure = Some(Failure { what, why });
            return;
        }
        let scene = &shown.state.wanted.scene.source;
        let stem = match scene {
            SceneSource::File(path) => path.file_stem().map(|s| s.to_string_lossy().into_owned()),
            generator => Some(files::stem(&generator.to_string())),
        };
        let (suffix, extension) = (export.suffix(), export.extensions()[0]);
        let name = format!("{}{suffix}.{extension}", stem.unwrap_or_default());
        let path = self.folder.clone().unwrap_or_default().join(name);
        let title = format!("Export: {}", export.name());
        self.asking = Some(SaveAs::new(export, title, &path, export.extensions()));
    }

    /// Shows the question, begins what was answered, says what was done; once a frame.
    pub fn show(&mut self, shown: &mut Shown<'_>, ctx: &egui::Context) {
        match self.asking.take().map(|asking| asking.show(ctx)) {
            Some(Ok(Answer::Save(export, path))) => self.begin(export, path, shown, ctx),
            Some(Err(open)) => self.asking = Some(open),
            Some(Ok(Answer::Cancel)) | None => {}
        }
        self.take(shown, ctx);
        self.crop(shown, ctx);
        self.running.retain(|(path, handle)| {
            let Some(end) = handle.receive().end else {
                return true;
            };
            let path = path.display();
            match end {
                End::Done(()) => shown.state.notices.say(format!("Exported: {path}")),
                End::Failed(why) => {
                    let what = format!("{path} could not be written");
                    shown.state.failure = Some(Failure { what, why });
                }
                End::Cancelled | End::Replaced => {}
            }
            false
        });
    }

    fn start(&mut self, path: PathBuf, make: MakeBytes, state: &State) {
        let export = jobs::Export {
            path: path.clone(),
            make,
        };
        self.running.push((path, state.jobs.start(export)));
    }

    fn begin(&mut self, export: Export, path: PathBuf, shown: &mut Shown<'_>, ctx: &egui::Context) {
        self.folder = path.parent().map(Path::to_owned);
        if export == Export::View3d {
            shown.state.notices.close();
            self.taking = Some((path, 3));
            return;
        }
        match make(export, shown, ctx) {
            Ok(make) => {
                let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
                let make = move || make(&extension.to_string_lossy());
                self.start(path, Box::new(make), shown.state);
            }
            Err(why) => {
                let what = format!("{} cannot be exported", export.name());
                shown.state.failure = Some(Failure { what, why });
            }
        }
    }

    /// Requests a picture of the window, when it is time.
    fn take(&mut self, shown: &mut Shown<'_>, ctx: &egui::Context) {
        let Some((path, frames)) = self.taking.take() else {
            return;
        };
        if let Some(frames) = frames.checked_sub(1) {
            self.taking = Some((path, frames));
            ctx.request_repaint();
            return;
        }
        let Some(rect) = shown.view3d.on_screen(ctx) else {
            let what = format!("{} could not be written", path.display());
            let why = "the 3D view is not on the screen".into();
            shown.state.failure = Some(Failure { what, why });
            return;
        };
        let (sender, receiver) = channel();
        let again = ctx.clone();
        let taken = move |image: Arc<egui::ColorImage>| {
            // Without a window nobody waits.
            let _ = sender.send(image);
            again.request_repaint();
        };
        let callback = egui::ScreenshotCallback::new(taken);
        ctx.send_viewport_cmd(egui::ViewportCommand::Screenshot(callback));
        self.screen = Some((path, rect, receiver));
    }

    /// Exports the part of the window that shows the 3D view, once its picture is there.
    fn crop(&mut self, shown: &Shown<'_>, ctx: &egui::Context) {
        let image = self.screen.as_ref().map(|(.., image)| image.try_recv());
        let Some(Ok(image)) = image else {
            return;
        };
        if let Some((path, rect, _)) = self.screen.take() {
            let pixels = ctx.pixels_per_point();
            let make = move || png(&image.region(&rect, Some(pixels)));
            self.start(path, Box::new(make), shown.state);
        }
    }

    /// The menu in the bar at the top.
    pub fn menu(ui: &mut egui::Ui) {
        ui.menu_button("Export", |ui| {
            for export in Export::ALL {
                let name = format!("{}…", export.name());
                let item = egui::Button::new(name).shortcut_text(text(export.action()));
                if ui.add(item).on_hover_text(export.about()).clicked() {
                    choose(ui.ctx(), export.action());
                }
            }
        })
        .response
        .on_hover_text("What is shown as files: pictures, figures, leaf boxes, a report");
    }
}

fn png(image: &egui::ColorImage) -> Result<Vec<u8>, String> {
    let [width, height] = image.size.map(|side| side as u32);
    let rgb = image.pixels.iter().flat_map(|p| [p.r(), p.g(), p.b()]);
    let image = image::RgbImage::from_raw(width, height, rgb.collect());
    let image = image.ok_or("the screen gave no picture")?;
    crate::present::export::png(&image).map_err(|error| error.to_string())
}

/// What makes the bytes, later and elsewhere; or why there is nothing to export.
fn make(export: Export, shown: &mut Shown<'_>, ctx: &egui::Context) -> Result<Make, String> {
    let Some(current) = &shown.state.current else {
        return Err("there is no picture yet".into());
    };
    match export {
        Export::Picture => {
            let picture = Arc::clone(&current.shown.picture);
            Ok(Box::new(move |extension| {
                encoded(&picture, format_of(extension)).map_err(|error| error.to_string())
            }))
        }
        Export::Heatmap => {
            let sheet = shown.heat.export(shown.state);
            let sheet = sheet.ok_or("no heatmap is shown, or it is not there yet")?;
            Ok(Box::new(move |extension| sheet(format_of(extension))))
        }
        Export::View3d => match shown.view3d.on_screen(ctx) {
            Some(_) => Ok(Box::new(|_| Err("taken from the screen".into()))),
            None => Err(format!(
                "the pane {} is not on the screen",
                Pane::View3d.title()
            )),
        },
        Export::Leaves => leaves(shown),
        Export::Figures => {
            let (report, _) = report(shown.state, ctx)?;
            Ok(Box::new(move |extension| {
                let writer = WRITERS.iter().find(|w| w.extension == extension);
                let mut bytes = Vec::new();
                let writer = writer.ok_or("no such form")?;
                (writer.write)(&report, &mut bytes).map_err(|error| error.to_string())?;
                Ok(bytes)
            }))
        }
        Export::Page => {
            let (report, counts) = report(shown.state, ctx)?;
            let notes = shown.state.notes.clone();
            let current = shown.state.current.as_ref().ok_or("no picture")?;
            let picture = Arc::clone(&current.shown.picture);
            Ok(Box::new(move |_| {
                let mut bytes = Vec::new();
                let counts: Vec<_> = counts.iter().map(Option::as_deref).collect();
                write_page(&report, &picture, &counts, &notes, &mut bytes)
                    .map_err(|error| error.to_string())?;
                Ok(bytes)
            }))
        }
    }
}

fn format_of(extension: &str) -> ImageFormat {
    match extension {
        "exr" => ImageFormat::OpenExr,
        _ => ImageFormat::Png,
    }
}

fn leaves(shown: &mut Shown<'_>) -> Result<Make, String> {
    let filter = shown.view3d.filter();
    let State {
        current,
        inspect,
        jobs,
        ..
    } = &mut *shown.state;
    let current = current.as_ref().ok_or("there is no tree yet")?;
    let visits = if filter.needs_visits() {
        let visits = inspect.visits.of(current, jobs);
        Some(visits.ok_or("the 3D view's filter needs visits, which are being counted")?)
    } else {
        None
    };
    let tree = Arc::clone(&current.shown.tree);
    let scene = current.shown.scene.name();
    let of = format!("{scene}, {}", tree.settings().method.name);
    Ok(Box::new(move |extension| {
        let visits = visits.as_ref().map(|visits| &visits.visits);
        let leaves = LeafCells::new(of, &tree, &filter, visits);
        let writer = LEAF_WRITERS.iter().find(|w| w.extension == extension);
        let mut bytes = Vec::new();
        let writer = writer.ok_or("no such form")?;
        (writer.write)(&leaves, &mut bytes).map_err(|error| error.to_string())?;
        Ok(bytes)
    }))
}

/// What every pixel cost, of every run of a report.
type Counts = Vec<Option<Arc<crate::measure::heat::PixelCounts>>>;

/// The final figures: of both trees where they may be compared, else of the one in front.
fn report(state: &mut State, ctx: &egui::Context) -> Result<(Report, Counts), String> {
    let verdict = state.verdict(ctx);
    let may_compare = verdict.is_some_and(|verdict| verdict.reasons.is_empty());
    let shown: Vec<&Current> = match (state.both(), may_compare) {
        ([Some(a), Some(b)], true) => vec![a, b],
        _ => state.current.iter().collect(),
    };
    if !shown.iter().all(|current| current.complete) {
        return Err("the figures are not final yet".into());
    }
    let first = shown.first().ok_or("there are no figures yet")?;
    let runs = shown.iter().map(|c| c.shown.measurement.clone()).collect();
    let report = Report::new(&first.shown.scene, &first.shown.setup.scene, runs);
    let counts = shown.iter().map(|c| c.pixel_counts.clone()).collect();
    Ok((report, counts))
}
