//! Writing a file.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::files::write_whole;
use std::path::PathBuf;

/// Makes the bytes of a file, or says why it cannot.
pub type MakeBytes = Box<dyn FnOnce() -> Result<Vec<u8>, String> + Send>;

/// Writes a file whole or not at all. What goes into it is made by the job, too.
pub struct Export {
    pub path: PathBuf,
    pub make: MakeBytes,
}

impl Job for Export {
    type Partial = ();
    type Output = ();

    fn place(&self) -> (Slot, Priority) {
        (Slot::unique("export"), Priority::Now)
    }

    fn run(self, context: &Context<()>) -> Result<(), JobError> {
        context.stage(format!("writing {}", self.path.display()));
        let mut make = Some(self.make);
        context.unit(|_| {
            // Nothing has a higher priority, so that it is not repeated.
            let make = make.take().ok_or_else(|| JobError::new("interrupted"))?;
            let bytes = make().map_err(JobError::new)?;
            Ok::<_, JobError>(write_whole(&self.path, |out| out.write_all(&bytes))?)
        })
    }
}
