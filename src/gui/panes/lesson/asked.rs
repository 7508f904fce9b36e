//! What the user asks for in the lesson's column.

/// What was asked for in the column.
#[derive(Clone, Debug, PartialEq)]
pub enum Asked {
    Back,
    /// Check the prediction.
    Check,
    Next,
    /// Set what the step looks at again.
    SetUp,
    Leave,
    /// Begin a lesson that comes with the program, by its place.
    Begin(usize),
    /// Open the file of a lesson.
    Open(String),
}
