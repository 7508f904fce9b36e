//! The text of a lesson: headings, paragraphs, lists, **bold**, *italic* and `code`.
//!
//! A parser and a viewer of our own, because lessons are read from the back of a room: the viewer that
//! exists for egui cannot set the distance of lines.

use crate::gui::theme;
use egui::text::{LayoutJob, TextFormat};
use egui::{Align, FontId, Label, TextStyle, Ui};

/// The distance of lines in points.
const LINE: f32 = 26.0;

/// A part of a text with a line of its own.
#[derive(Debug, PartialEq)]
enum Block {
    Heading(String),
    Paragraph(String),
    /// What stands before an item of a list, and the item.
    Item(String, String),
    Code(String),
}

/// How a piece of text is set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Face {
    bold: bool,
    italic: bool,
    code: bool,
}

/// Shows a text; each block is one label.
pub fn show(ui: &mut Ui, text: &str) {
    ui.spacing_mut().item_spacing.y = 12.0;
    for block in blocks(text) {
        match block {
            Block::Heading(text) => {
                ui.label(theme::heading(text));
            }
            Block::Paragraph(text) => {
                ui.add(Label::new(job(ui, &text)).wrap());
            }
            Block::Item(mark, text) => {
                ui.horizontal_top(|ui| {
                    ui.label(job(ui, &mark));
                    ui.add(Label::new(job(ui, &text)).wrap());
                });
            }
            Block::Code(text) => {
                ui.add(Label::new(egui::RichText::new(text).monospace()).wrap());
            }
        }
    }
}

/// Splits a text into its blocks.
fn blocks(text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut fenced = false;
    // Whether the last line ended a block.
    let mut ended = true;
    for line in text.lines() {
        let trimmed = line.trim();
        if trimmed.starts_with("```") {
            fenced = !fenced;
            if fenced {
                blocks.push(Block::Code(String::new()));
            }
            ended = true;
            continue;
        }
        if fenced {
            if let Some(Block::Code(code)) = blocks.last_mut() {
                if !code.is_empty() {
                    code.push('\n');
                }
                code.push_str(line);
            }
        } else if trimmed.is_empty() {
            ended = true;
        } else if let Some(heading) = heading(trimmed) {
            blocks.push(Block::Heading(heading.to_owned()));
            ended = true;
        } else if let Some((mark, item)) = item(trimmed) {
            blocks.push(Block::Item(mark, item.to_owned()));
            ended = false;
        } else {
            match blocks.last_mut() {
                Some(Block::Paragraph(text) | Block::Item(_, text)) if !ended => {
                    text.push(' ');
                    text.push_str(trimmed);
                }
                _ => blocks.push(Block::Paragraph(trimmed.to_owned())),
            }
            ended = false;
        }
    }
    blocks
}

fn heading(line: &str) -> Option<&str> {
    let text = line.trim_start_matches('#');
    (text.len() < line.len()).then(|| text.strip_prefix(' '))?
}

/// The mark of a list's item, and the item.
fn item(line: &str) -> Option<(String, &str)> {
    if let Some(text) = line.strip_prefix("- ").or(line.strip_prefix("* ")) {
        return Some(("•".to_owned(), text));
    }
    let (number, text) = line.split_once(". ")?;
    let is_number = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
    is_number.then(|| (format!("{number}."), text))
}

/// Splits a block into pieces that are set alike.
fn pieces(text: &str) -> Vec<(String, Face)> {
    let mut pieces: Vec<(String, Face)> = Vec::new();
    let mut face = Face::default();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let sign = ["**", "*", "`"].into_iter().find(|sign| {
            // In code, other signs stand for themselves; and so do those of a product.
            let known = rest.starts_with(sign) && (*sign == "`" || !face.code);
            known && (face.is_open(sign) || opens(sign, &rest[sign.len()..]))
        });
        if let Some(sign) = sign {
            face.turn(sign);
            rest = &rest[sign.len()..];
            continue;
        }
        match pieces.last_mut() {
            Some((text, known)) if *known == face => text.push(first),
            _ => pieces.push((first.to_string(), face)),
        }
        rest = &rest[first.len_utf8()..];
    }
    pieces
}

/// Whether a sign before this text begins a piece.
fn opens(sign: &str, after: &str) -> bool {
    !after.starts_with(' ') && after.contains(sign)
}

impl Face {
    fn part(&mut self, sign: &str) -> &mut bool {
        match sign {
            "**" => &mut self.bold,
            "*" => &mut self.italic,
            _ => &mut self.code,
        }
    }

    fn is_open(mut self, sign: &str) -> bool {
        *self.part(sign)
    }

    fn turn(&mut self, sign: &str) {
        let part = self.part(sign);
        *part = !*part;
    }
}

/// Lays a block out.
fn job(ui: &Ui, text: &str) -> LayoutJob {
    let t = theme::tokens(ui);
    let font = theme::named(theme::LESSON).resolve(ui.style());
    let mut job = LayoutJob::default();
    for (text, face) in pieces(text) {
        let font_id = match face {
            Face { code: true, .. } => TextStyle::Monospace.resolve(ui.style()),
            Face { bold: true, .. } => FontId::new(font.size, theme::semibold()),
            _ => font.clone(),
        };
        let format = TextFormat {
            font_id,
            color: t.text,
            background: if face.code {
                t.control
            } else {
                egui::Color32::TRANSPARENT
            },
            italics: face.italic,
            line_height: Some(LINE),
            valign: Align::Center,
            ..TextFormat::default()
        };
        job.append(&text, 0.0, format);
    }
    job
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_told_apart() {
        let text =
            "One\ntwo.\n\nThree\n\n## Four\nfive\n- a\n  b\n- c\n1. d\n\n```\n# x\n\ny\n```\nend";
        let paragraph = |text: &str| Block::Paragraph(text.to_owned());
        let item = |mark: &str, text: &str| Block::Item(mark.to_owned(), text.to_owned());
        assert_eq!(
            blocks(text),
            [
                paragraph("One two."),
                paragraph("Three"),
                Block::Heading("Four".to_owned()),
                paragraph("five"),
                item("•", "a b"),
                item("•", "c"),
                item("1.", "d"),
                Block::Code("# x\n\ny".to_owned()),
                paragraph("end"),
            ]
        );
        assert!(blocks(" \n").is_empty());
        // These are no headings and no items.
        for text in ["#hash", "-1 is less", "Version 2. It", "…"] {
            assert_eq!(blocks(text), [paragraph(text)]);
        }
    }

    #[test]
    fn pieces_have_their_faces() {
        let face = |bold, italic, code| Face { bold, italic, code };
        let plain = Face::default();
        let piece = |text: &str, face| (text.to_owned(), face);
        assert_eq!(
            pieces("**53** tests: *half* of `a*b` × 2 * 3"),
            [
                piece("53", face(true, false, false)),
                piece(" tests: ", plain),
                piece("half", face(false, true, false)),
                piece(" of ", plain),
                piece("a*b", face(false, false, true)),
                piece(" × 2 * 3", plain),
            ]
        );
        // A sign of no pair stands for itself.
        for text in ["2 * 3 * 4", "*", "a ` b"] {
            assert_eq!(pieces(text), [piece(text, plain)]);
        }
    }
}
