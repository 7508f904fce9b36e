//! Exports: the question where to, and the work in the background.

use super::save_as::{Answer, SaveAs};
use crate::files;
use crate::gui::document::{Document, Failure};
use crate::gui::edits::{Content, Export};
use crate::jobs::{self, End, Handle, MakeBytes};
use crate::scene::SceneSource;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

/// Frames until the question is gone from the screen, before a picture of it is taken.
const FRAMES: u8 = 3;

/// Exports that are asked for or under way.
#[derive(Default)]
pub struct Exports {
    asking: Option<SaveAs<Box<Export>>>,
    /// A part of the screen to be taken, with the frames to go.
    taking: Option<(PathBuf, egui::Rect, u8)>,
    /// A picture of the whole window that was requested, for this part of it.
    screen: Option<(PathBuf, egui::Rect, Receiver<Arc<egui::ColorImage>>)>,
    running: Vec<(PathBuf, Handle<jobs::Export>)>,
    /// Where the last file went.
    folder: Option<PathBuf>,
}

impl Exports {
    /// Asks where to write; says so where there is nothing to.
    pub fn ask(&mut self, export: Box<Export>, doc: &mut Document) {
        if let Content::Nothing(why) = &export.content {
            let why = why.clone();
            let what = format!("{} cannot be exported", export.name);
            doc.failure = Some(Failure { what, why });
            return;
        }
        let stem = match &doc.wanted.scene.source {
            SceneSource::File(path) => path.file_stem().map(|s| s.to_string_lossy().into_owned()),
            generator => Some(files::stem(&generator.to_string())),
        };
        let (suffix, extension) = (export.suffix, export.extensions[0]);
        let name = format!("{}{suffix}.{extension}", stem.unwrap_or_default());
        let path = self.folder.clone().unwrap_or_default().join(name);
        let title = format!("Export: {}", export.name);
        let extensions = export.extensions.clone();
        self.asking = Some(SaveAs::new(export, title, &path, extensions));
    }

    /// Shows the question, begins what was answered, says what was done; once a frame.
    pub fn show(&mut self, doc: &mut Document, ctx: &egui::Context) {
        match self.asking.take().map(|asking| asking.show(ctx)) {
            Some(Ok(Answer::Save(export, path))) => self.begin(*export, path, doc),
            Some(Err(open)) => self.asking = Some(open),
            Some(Ok(Answer::Cancel)) | None => {}
        }
        self.take(ctx);
        self.crop(doc, ctx);
        self.running.retain(|(path, handle)| {
            let Some(end) = handle.receive().end else {
                return true;
            };
            let path = path.display();
            match end {
                End::Done(()) => doc.notices.say(format!("Exported: {path}")),
                End::Failed(why) => {
                    let what = format!("{path} could not be written");
                    doc.failure = Some(Failure { what, why });
                }
                End::Cancelled | End::Replaced => {}
            }
            false
        });
    }

    fn start(&mut self, path: PathBuf, make: MakeBytes, doc: &Document) {
        let export = jobs::Export {
            path: path.clone(),
            make,
        };
        self.running.push((path, doc.jobs.start(export)));
    }

    fn begin(&mut self, export: Export, path: PathBuf, doc: &mut Document) {
        self.folder = path.parent().map(Path::to_owned);
        match export.content {
            Content::Screen(rect) => {
                doc.notices.close();
                self.taking = Some((path, rect, FRAMES));
            }
            Content::File(make) => {
                let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
                let make = move || make(&extension.to_string_lossy());
                self.start(path, Box::new(make), doc);
            }
            Content::Nothing(_) => {}
        }
    }

    /// Requests a picture of the window, when it is time.
    fn take(&mut self, ctx: &egui::Context) {
        let Some((path, rect, frames)) = self.taking.take() else {
            return;
        };
        if let Some(frames) = frames.checked_sub(1) {
            self.taking = Some((path, rect, frames));
            ctx.request_repaint();
            return;
        }
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

    /// Exports the part of the window that was asked for, once its picture is there.
    fn crop(&mut self, doc: &Document, ctx: &egui::Context) {
        let image = self.screen.as_ref().map(|(.., image)| image.try_recv());
        let Some(Ok(image)) = image else {
            return;
        };
        if let Some((path, rect, _)) = self.screen.take() {
            let pixels = ctx.pixels_per_point();
            let make = move || png(&image.region(&rect, Some(pixels)));
            self.start(path, Box::new(make), doc);
        }
    }
}

fn png(image: &egui::ColorImage) -> Result<Vec<u8>, String> {
    let [width, height] = image.size.map(|side| side as u32);
    let rgb = image.pixels.iter().flat_map(|p| [p.r(), p.g(), p.b()]);
    let image = image::RgbImage::from_raw(width, height, rgb.collect());
    let image = image.ok_or("the screen gave no picture")?;
    crate::present::export::png(&image).map_err(|error| error.to_string())
}
