//! Workspaces as files: opened and saved in the background; the last session is kept.

use super::kept;
use super::save_as::{Answer, SaveAs};
use crate::files;
use crate::gui::StartOptions;
use crate::gui::document::notices::Notices;
use crate::gui::document::tasks::{Task, take, task};
use crate::gui::document::{Document, Failure, Wanted};
use crate::scene::SceneSource;
use crate::setup::Setup;
use crate::workspace::{EXTENSION, Workspace};
use std::path::{Path, PathBuf};

/// The name of the file in which the last session is kept.
const SESSION: &str = "session.bspscope";

/// How often the session is kept while it changes, in seconds.
const EVERY: f64 = 2.0;

/// Files of workspaces, and the one that is open.
#[derive(Default)]
pub struct Workspaces {
    /// The workspace that was opened or saved last.
    open: Option<Open>,
    opening: Option<(PathBuf, Task<Result<Workspace, String>>)>,
    /// Whether the scene of a workspace that was opened is another than when it was saved.
    comparing: Option<(SceneSource, Task<bool>)>,
    asking: Option<SaveAs<()>>,
    saving: Option<(PathBuf, Task<std::io::Result<()>>)>,
    /// `None` where nothing is kept.
    session: Option<PathBuf>,
    /// What was kept last, and when.
    kept: (String, f64),
}

/// A workspace in a file.
struct Open {
    path: PathBuf,
    /// The setups that the file has.
    a: Setup,
    b: Option<Setup>,
}

impl Open {
    /// Whether the file is of the scene that is wanted now: no other scene may overwrite it.
    fn is_of(&self, wanted: &Setup) -> bool {
        self.a.scene.source == wanted.scene.source
    }
}

/// Reads a workspace; its scene must be there.
fn read(path: &Path) -> Result<Workspace, String> {
    let workspace = Workspace::read(path).map_err(|error| error.to_string())?;
    match workspace.missing_scene() {
        Some(scene) => Err(format!("its scene is not there: {}", scene.display())),
        None => Ok(workspace),
    }
}

impl Workspaces {
    /// With the workspace or the last session that the start options ask for, if it can be had;
    /// if not, `notices` says why.
    pub fn new(
        start: &StartOptions,
        ctx: &egui::Context,
        notices: &mut Notices,
    ) -> (Self, Option<Workspace>) {
        let mut workspaces = Workspaces {
            session: kept::place(start, SESSION),
            ..Workspaces::default()
        };
        if let Some((path, workspace)) = &start.workspace {
            workspaces.opened(path, workspace, ctx);
            return (workspaces, Some(workspace.clone()));
        }
        let session = workspaces.session.as_deref().filter(|_| start.last_session);
        let last = match session.filter(|path| path.exists()).map(read) {
            None => None,
            Some(Ok(workspace)) => Some(workspace),
            Some(Err(why)) => {
                notices.say(format!("The last session could not be restored: {why}"));
                None
            }
        };
        (workspaces, last)
    }

    /// Reads a workspace in the background.
    pub fn open(&mut self, path: PathBuf, ctx: &egui::Context) {
        let reading = path.clone();
        let task = task(ctx, move || read(&reading));
        self.opening = Some((path, task));
    }

    /// Takes note of a workspace that was read, and compares its scene with the one it was saved of.
    fn opened(&mut self, path: &Path, workspace: &Workspace, ctx: &egui::Context) {
        self.open = Some(Open {
            path: path.to_owned(),
            a: workspace.a.clone(),
            b: workspace.b.clone(),
        });
        let (source, compared) = (workspace.a.scene.source.clone(), workspace.clone());
        let task = task(ctx, move || compared.scene_was_changed());
        self.comparing = Some((source, task));
    }

    /// Takes what was done since the last frame; gives a workspace that was read.
    pub fn receive(
        &mut self,
        doc: &mut Document,
        ctx: &egui::Context,
    ) -> Option<(PathBuf, Workspace)> {
        self.saved(doc);
        if let Some((source, task)) = &self.comparing
            && let Some(changed) = take(task)
        {
            if changed == Some(true) {
                doc.notices.say(format!(
                    "{source} was changed since this workspace was saved: figures may differ."
                ));
            }
            self.comparing = None;
        }
        let (path, task) = self.opening.as_ref()?;
        let result = take(task)?;
        let path = path.clone();
        self.opening = None;
        match result.unwrap_or_else(|| Err("reading it broke off".into())) {
            Ok(workspace) => {
                self.opened(&path, &workspace, ctx);
                Some((path, workspace))
            }
            Err(why) => {
                let what = format!("{} could not be opened", path.display());
                doc.failure = Some(Failure { what, why });
                None
            }
        }
    }

    /// Says how saving ended.
    fn saved(&mut self, doc: &mut Document) {
        let Some((path, task)) = &self.saving else {
            return;
        };
        let Some(result) = take(task) else {
            return;
        };
        let path = path.display();
        let why = match result {
            Some(Ok(())) => None,
            Some(Err(error)) => Some(error.to_string()),
            None => Some("writing it broke off".into()),
        };
        match why {
            None => doc.notices.say(format!("Workspace saved: {path}")),
            Some(why) => {
                let what = format!("{path} could not be saved");
                doc.failure = Some(Failure { what, why });
            }
        }
        self.saving = None;
    }

    /// Saves to where the workspace of this scene was opened from or saved to; asks where, if there is
    /// no such place.
    pub fn save(&mut self, workspace: Workspace, ctx: &egui::Context) {
        match self.path_for(&workspace.a) {
            Some(path) => self.write(path, workspace, ctx),
            None => self.ask(&workspace),
        }
    }

    /// Whether a workspace of this scene is open and has other setups than its file.
    pub fn is_changed(&self, Wanted { a, b }: &Wanted) -> bool {
        let open = self.open.as_ref().filter(|open| open.is_of(a));
        open.is_some_and(|open| open.a != *a || open.b != *b)
    }

    fn path_for(&self, wanted: &Setup) -> Option<PathBuf> {
        let open = self.open.as_ref().filter(|open| open.is_of(wanted))?;
        Some(open.path.clone())
    }

    /// Asks where to save.
    pub fn ask(&mut self, workspace: &Workspace) {
        let path = self.path_for(&workspace.a).unwrap_or_else(|| {
            let source = &workspace.a.scene.source;
            let name = match source {
                SceneSource::File(path) => path.with_extension(EXTENSION),
                generator => files::stem(&generator.to_string()).into(),
            };
            name.with_extension(EXTENSION)
        });
        self.asking = Some(SaveAs::new(
            (),
            "Save the workspace",
            &path,
            vec![EXTENSION],
        ));
    }

    /// Shows the question where to save.
    pub fn show(
        &mut self,
        ctx: &egui::Context,
        workspace: impl FnOnce() -> Workspace,
    ) -> Option<PathBuf> {
        match self.asking.take()?.show(ctx) {
            Ok(Answer::Save((), path)) => {
                self.write(path.clone(), workspace(), ctx);
                Some(path)
            }
            Ok(Answer::Cancel) => None,
            Err(open) => {
                self.asking = Some(open);
                None
            }
        }
    }

    fn write(&mut self, path: PathBuf, mut workspace: Workspace, ctx: &egui::Context) {
        self.open = Some(Open {
            path: path.clone(),
            a: workspace.a.clone(),
            b: workspace.b.clone(),
        });
        let to = path.clone();
        let task = task(ctx, move || {
            if let SceneSource::File(scene) = &workspace.a.scene.source {
                workspace.scene_sha256 = files::sha256(scene).ok();
            }
            workspace.write(&to)
        });
        self.saving = Some((path, task));
    }

    /// Keeps the session, now and then or at once; failing to is no error.
    pub fn keep(&mut self, now: f64, at_once: bool, workspace: impl FnOnce() -> Workspace) {
        let (kept, then) = &mut self.kept;
        let Some(path) = self
            .session
            .as_deref()
            .filter(|_| at_once || now - *then >= EVERY)
        else {
            return;
        };
        *then = now;
        let text = workspace().to_text(None);
        if *kept != text {
            kept::keep(path, text.as_bytes());
            *kept = text;
        }
    }
}
