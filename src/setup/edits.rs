//! Settings as text: `method=sah-cut,d-max=16,precision=f32`.

use super::{Setting, Setup, setting};

/// Settings by name with the text of their values, in their original order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Edits(Vec<(String, String)>);

impl Edits {
    /// Parses pairs `NAME=VALUE`, separated by commas: any settings and constants of the method.
    /// The method, or `tree` with a tree file, must be among them. A part without `=` belongs to the previous value, as in
    /// `from=0,-4,1.5`.
    ///
    /// # Errors
    /// One sentence on what is wrong.
    pub fn parse(text: &str) -> Result<Edits, String> {
        let mut pairs: Vec<(String, String)> = Vec::new();
        for part in text.split(',') {
            match (part.split_once('='), pairs.last_mut()) {
                (Some((name, value)), _) => {
                    pairs.push((name.trim().to_owned(), value.trim().to_owned()));
                }
                (None, Some((_, value))) => *value += &format!(",{}", part.trim()),
                (None, None) => return Err(format!("expected NAME=VALUE, found '{part}'")),
            }
        }
        if !pairs.iter().any(is_method) {
            return Err("expected method=NAME among the settings".into());
        }
        let edits = Edits(pairs);
        edits.apply(&Setup::default())?;
        Ok(edits)
    }

    /// Adds a setting.
    pub fn push(&mut self, name: impl Into<String>, value: impl Into<String>) {
        self.0.push((name.into(), value.into()));
    }

    /// Returns a setup with these settings changed. The method is applied first, because it resets
    /// the constants.
    ///
    /// # Errors
    /// One sentence on what is wrong.
    pub fn apply(&self, setup: &Setup) -> Result<Setup, String> {
        let mut setup = setup.clone();
        let others = self.0.iter().filter(|pair| !is_method(pair));
        let methods = self.0.iter().filter(|pair| is_method(pair));
        for (name, text) in methods.chain(others) {
            let setting = setup.setting(name)?;
            let value = setting.parse(text);
            let value = value.map_err(|reason| format!("{name}: {reason}"))?;
            setting.store(&mut setup, value);
        }
        Ok(setup)
    }
}

/// Returns whether a pair of name and value is the method.
fn is_method((name, _): &(String, String)) -> bool {
    setting("method").is_some_and(|method| method.is_called(name))
}

impl std::str::FromStr for Edits {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Edits::parse(text)
    }
}

impl Setup {
    /// Returns all settings as text that [`Edits::parse`] reads.
    pub fn to_text(&self) -> String {
        let pairs = self
            .settings()
            .map(|s| format!("{}={}", s.name, s.text(self)));
        pairs.collect::<Vec<_>>().join(",")
    }

    /// Returns the settings that are not at their defaults.
    pub fn differences(&self) -> impl Iterator<Item = Setting> {
        self.settings().filter(|s| !s.is_default(self))
    }
}
