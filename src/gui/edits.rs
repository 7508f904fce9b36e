//! What panes return: edits of the document, and requests to the shell. Both are applied right after the
//! pane has been drawn.

use super::document::Document;

/// A change of the document.
type Edit = Box<dyn FnOnce(&mut Document)>;

/// Makes the bytes of a file with this extension, in the background.
pub type MakeFile = Box<dyn FnOnce(&str) -> Result<Vec<u8>, String> + Send>;

/// Something to be written to a file that the user names.
pub struct Export {
    /// Such as "Heatmap".
    pub name: &'static str,
    /// What is added to the scene's name to suggest a file name.
    pub suffix: &'static str,
    /// File name extensions; the first is the default.
    pub extensions: Vec<&'static str>,
    pub content: Content,
}

/// What an export is made of.
pub enum Content {
    File(MakeFile),
    /// This part of the window, as it is on the screen.
    Screen(egui::Rect),
    /// There is nothing to export, for this reason.
    Nothing(String),
}

/// What only the shell can do.
pub enum Request {
    /// Bring a pane to the front.
    Show(&'static str),
    /// Switch to a task.
    Task(&'static str),
    /// Show these panes beside a lesson: slots from left to right, each with panes from the top; the
    /// usual ones if there are none.
    Stage(Vec<Vec<&'static str>>),
    /// Run an action.
    Run(&'static str),
    /// Ask for a file name and write this to it.
    Export(Box<Export>),
    /// Put a text on the clipboard.
    Copy(String),
}

/// What a pane wants changed.
#[derive(Default)]
pub struct Edits {
    edits: Vec<Edit>,
    requests: Vec<Request>,
}

impl Edits {
    /// Adds a change of the document.
    pub fn add(&mut self, edit: impl FnOnce(&mut Document) + 'static) {
        self.edits.push(Box::new(edit));
    }

    /// Adds a request to the shell.
    pub fn request(&mut self, request: Request) {
        self.requests.push(request);
    }

    /// Applies the changes, in order; returns the requests.
    pub fn apply(self, doc: &mut Document) -> Vec<Request> {
        for edit in self.edits {
            edit(doc);
        }
        self.requests
    }
}
