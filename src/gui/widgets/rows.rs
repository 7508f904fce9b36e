//! A list of rows with columns, of which only those in view are made; a row is one widget.

use crate::gui::theme;
use egui::text::{LayoutJob, TextWrapping};
use egui::{Align2, Color32, FontId, Painter, Rect, Sense, pos2, vec2};

/// A column of a [`List`].
#[derive(Clone, Copy)]
pub struct Column {
    pub title: &'static str,
    /// What the column tells, on hover.
    pub about: &'static str,
    /// In points; the last column takes what is left.
    pub width: f32,
}

/// A row of a [`List`].
pub struct Row {
    /// What stands in the columns.
    pub cells: Vec<String>,
    /// All of it in words: the row's name and its tooltip.
    pub label: String,
}

/// A list of rows.
pub struct List<'a> {
    pub name: &'static str,
    pub columns: &'a [Column],
    pub rows: usize,
    /// The row that is highlighted, and scrolled to when it is another than before.
    pub selected: Option<usize>,
    /// The most rows in view.
    pub most: usize,
    /// The height of a row in points.
    pub row: f32,
}

impl List<'_> {
    /// Shows the list; returns the row that was clicked. `mark` paints into a row's first column, in
    /// the rectangle and with the color of text that it is given.
    pub fn show(
        self,
        ui: &mut egui::Ui,
        row: impl Fn(usize) -> Row,
        mark: impl Fn(usize, &Painter, Rect, Color32),
    ) -> Option<usize> {
        ui.push_id(self.name, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            let height = self.row;
            self.header(ui, height);
            self.body(ui, height, row, mark)
        })
        .inner
    }

    /// Left and right end of every column.
    fn columns(&self, line: Rect) -> Vec<Rect> {
        let mut left = line.left();
        let last = self.columns.len() - 1;
        let mut rects = Vec::new();
        for (i, column) in self.columns.iter().enumerate() {
            let right = if i == last {
                line.right()
            } else {
                left + column.width
            };
            rects.push(Rect::from_min_max(
                pos2(left + 2.0, line.top()),
                pos2((right - 3.0).max(left + 3.0), line.bottom()),
            ));
            left = right;
        }
        rects
    }

    fn header(&self, ui: &mut egui::Ui, height: f32) {
        let size = vec2(ui.available_width(), height);
        let (line, _) = ui.allocate_exact_size(size, Sense::hover());
        let color = ui.visuals().strong_text_color();
        for (column, rect) in self.columns.iter().zip(self.columns(line)) {
            text(ui, rect, column.title.to_owned(), color);
            if !column.about.is_empty() {
                ui.interact(rect, ui.scope_id().with(column.title), Sense::hover())
                    .on_hover_text(column.about);
            }
        }
    }

    fn body(
        &self,
        ui: &mut egui::Ui,
        height: f32,
        row: impl Fn(usize) -> Row,
        mark: impl Fn(usize, &Painter, Rect, Color32),
    ) -> Option<usize> {
        let seen = ui.scope_id().with("seen");
        let now = (self.selected, self.rows);
        let reveal = ui.data(|data| data.get_temp(seen)) != Some(now);
        ui.data_mut(|data| data.insert_temp(seen, now));
        let mut clicked = None;
        egui::ScrollArea::vertical()
            .id_salt(self.name)
            .max_height(height * self.most as f32)
            .min_scrolled_height(height * self.most as f32)
            .auto_shrink([false, true])
            .show_rows(ui, height, self.rows, |ui, range| {
                if reveal && let Some(selected) = self.selected {
                    let first = ui.max_rect().min - vec2(0.0, height * range.start as f32);
                    let top = first + vec2(0.0, height * selected as f32);
                    let target = Rect::from_min_size(top, vec2(1.0, height));
                    let still = egui::style::ScrollAnimation::none();
                    ui.scroll_to_rect_animation(target, None, still);
                }
                for i in range {
                    if self.line(ui, height, i, &row(i), &mark) {
                        clicked = Some(i);
                    }
                }
            });
        clicked
    }

    /// One row; says whether it was clicked.
    fn line(
        &self,
        ui: &mut egui::Ui,
        height: f32,
        i: usize,
        row: &Row,
        mark: &impl Fn(usize, &Painter, Rect, Color32),
    ) -> bool {
        let size = vec2(ui.available_width(), height);
        let (line, response) = ui.allocate_exact_size(size, Sense::click());
        let selected = self.selected == Some(i);
        response.widget_info(|| {
            egui::WidgetInfo::selected(egui::Role::Button, true, selected, &row.label)
        });
        if ui.is_rect_visible(line) {
            let visuals = ui.style().interact_selectable(&response, selected);
            let fill = if selected || response.hovered() || response.has_focus() {
                visuals.bg_fill
            } else if i % 2 == 1 {
                ui.visuals().faint_bg_color
            } else {
                Color32::TRANSPARENT
            };
            ui.painter().rect_filled(line, 2.0, fill);
            let columns = self.columns(line);
            mark(i, ui.painter(), columns[0], visuals.text_color());
            for (cell, rect) in row.cells.iter().zip(&columns) {
                text(ui, *rect, cell.clone(), visuals.text_color());
            }
        }
        response.on_hover_text(&row.label).clicked()
    }
}

/// Text in one line, cut off with an ellipsis where it is too long.
fn text(ui: &egui::Ui, rect: Rect, text: String, color: Color32) {
    if text.is_empty() {
        return;
    }
    let font = theme::named(theme::HINT).resolve(ui.style());
    let mut job = LayoutJob::simple_singleline(text, font, color);
    job.wrap = TextWrapping::truncate_at_width(rect.width());
    let galley = ui.painter().layout_job(job);
    let at = Align2::LEFT_CENTER.align_size_within_rect(galley.size(), rect);
    ui.painter().galley(at.min, galley, color);
}

/// A letter on a dark ground: bright colors can be read in both themes.
pub fn chip(painter: &Painter, at: Rect, letter: &str, [r, g, b]: [u8; 3]) {
    painter.rect_filled(at, 3.0, Color32::from_gray(24));
    let font = FontId::monospace(at.height() - 2.0);
    let color = Color32::from_rgb(r, g, b);
    painter.text(at.center(), Align2::CENTER_CENTER, letter, font, color);
}
