//! Markdown with figures in braces, such as `{a.N_LS}` or `{b.N_IT / a.N_IT as %}`.

use super::figures::{Figures, Name};
use super::formula::{Formula, Style};

/// Markdown with placeholders for figures.
#[derive(Clone, Debug, Default)]
pub struct Prose {
    pieces: Vec<Piece>,
}

#[derive(Clone, Debug)]
enum Piece {
    Text(String),
    Value(Placeholder),
}

/// A placeholder for a figure.
#[derive(Clone, Debug)]
pub struct Placeholder {
    /// Line in the file, counted from 1.
    pub line: usize,
    /// The text between the braces.
    pub text: String,
    pub formula: Formula,
    style: Style,
}

impl Prose {
    /// Parses Markdown whose first line is line number `line` of its file.
    ///
    /// # Errors
    /// Line and reason: unbalanced braces or an invalid formula.
    pub fn parse(text: &str, line: usize) -> Result<Prose, (usize, String)> {
        let mut pieces = Vec::new();
        for (i, row) in text.trim_end().split_inclusive('\n').enumerate() {
            let at = line + i;
            let mut rest = row;
            while let Some((before, after)) = rest.split_once('{') {
                let (inner, after) = after
                    .split_once('}')
                    .ok_or_else(|| (at, "'{' without '}' on its line".to_owned()))?;
                pieces.push(Piece::Text(before.to_owned()));
                pieces.push(Piece::Value(placeholder(inner, at)?));
                rest = after;
            }
            if rest.contains('}') {
                return Err((at, "'}' without '{' before it".into()));
            }
            pieces.push(Piece::Text(rest.to_owned()));
        }
        Ok(Prose { pieces })
    }

    /// Returns the Markdown with all figures filled in, or with `…` in place of each if there are
    /// no figures yet.
    pub fn fill(&self, figures: Option<&Figures>) -> String {
        self.fill_with(|value| figures.map_or_else(|| "…".to_owned(), |of| value.write(of)))
    }

    /// Returns the Markdown with a text in place of every figure.
    pub fn fill_with(&self, text_of: impl Fn(&Placeholder) -> String) -> String {
        let pieces = self.pieces.iter().map(|piece| match piece {
            Piece::Text(text) => text.clone(),
            Piece::Value(value) => text_of(value),
        });
        pieces.collect()
    }

    /// Returns all placeholders.
    pub fn placeholders(&self) -> impl Iterator<Item = &Placeholder> {
        self.pieces.iter().filter_map(|piece| match piece {
            Piece::Value(value) => Some(value),
            Piece::Text(_) => None,
        })
    }

    /// Returns the names of all figures, with their lines.
    pub fn names(&self) -> impl Iterator<Item = (usize, &Name)> {
        self.placeholders().flat_map(|value| {
            let names = value.formula.names().into_iter();
            names.map(|name| (value.line, name))
        })
    }

    pub fn is_empty(&self) -> bool {
        self.pieces
            .iter()
            .all(|piece| matches!(piece, Piece::Text(text) if text.trim().is_empty()))
    }
}

impl Placeholder {
    /// Formats the figure; `–` if it has no value.
    pub fn write(&self, figures: &Figures) -> String {
        self.formula.write(self.formula.value(figures), self.style)
    }
}

fn placeholder(inner: &str, line: usize) -> Result<Placeholder, (usize, String)> {
    let (text, style) = match inner.split_once(" as ") {
        None => (inner, Style::Plain),
        Some((text, "%")) => (text, Style::Percent),
        Some((text, "whole")) => (text, Style::Whole),
        Some((_, other)) => {
            let reason = format!("{{{inner}}}: expected 'as %' or 'as whole', found 'as {other}'");
            return Err((line, reason));
        }
    };
    let formula = Formula::parse(text);
    Ok(Placeholder {
        line,
        text: inner.to_owned(),
        formula: formula.map_err(|reason| (line, format!("{{{inner}}}: {reason}")))?,
        style,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_found_with_their_lines() {
        let text = "One\ntwo {a.N_LS} and {b.N_IT / a.N_IT as %}.\n\n{1 + 1 as whole}\n";
        let prose = Prose::parse(text, 10).unwrap();
        let lines: Vec<_> = prose.placeholders().map(|value| value.line).collect();
        assert_eq!(lines, [11, 11, 13]);
        assert_eq!(prose.names().count(), 3);
        assert_eq!(prose.fill(None), "One\ntwo … and ….\n\n…");
        assert!(!prose.is_empty());
        assert!(Prose::parse("\n \n", 1).unwrap().is_empty());
    }

    #[test]
    fn unbalanced_braces_are_reported_with_their_line() {
        for (text, line) in [
            ("a\nb {a.N_LS", 2),
            ("a }", 1),
            ("\n\n{a.NO}", 3),
            ("{a.N_LS as x}", 1),
        ] {
            assert_eq!(Prose::parse(text, 1).unwrap_err().0, line, "{text}");
        }
    }
}
