//! Where a task shows its panes: columns and rows of fixed size, and tiles.

use super::app::App;
use super::places::{self, Column, PaneId, TITLE_ROW};
use crate::gui::icons;
use crate::gui::theme::IconButton;
use egui_tiles::{SimplificationOptions, Tile, TileId, UiResponse};

impl App {
    /// Draws the column at the left.
    pub(super) fn left_column(&mut self, ui: &mut egui::Ui, column: &Column) {
        egui::Panel::left("left column")
            .exact_size(column.size(ui.ctx().content_rect().size()))
            .resizable(false)
            .show(ui, |ui| self.column(ui, column.panes));
    }

    /// Draws the row below.
    pub(super) fn row_below(&mut self, ui: &mut egui::Ui, row: &Column) {
        let frame = egui::Frame::new().fill(ui.visuals().panel_fill);
        // Its panes divide the height among themselves.
        egui::Panel::bottom("row below")
            .exact_size(row.size(ui.ctx().content_rect().size()))
            .resizable(false)
            .frame(frame.inner_margin(egui::Margin::symmetric(8, 0)))
            .show(ui, |ui| {
                for pane in row.panes.iter().filter_map(|id| places::pane(id)) {
                    self.pane(ui, pane);
                }
            });
    }

    /// Draws the tiles of the current task in what is left.
    pub(super) fn tiles(&mut self, ui: &mut egui::Ui) {
        let mut tiles = self.layout.tiles().clone();
        egui::CentralPanel::default()
            .frame(egui::Frame::new().fill(ui.visuals().panel_fill))
            .show(ui, |ui| {
                let mut behavior = Behavior { app: self };
                tiles.ui(&mut behavior, ui);
            });
        *self.layout.tiles() = tiles;
    }
}

/// Draws tiles with the window's panes.
pub struct Behavior<'a> {
    pub app: &'a mut App,
}

impl Behavior<'_> {
    fn active(tiles: &egui_tiles::Tiles<PaneId>, tabs: &egui_tiles::Tabs) -> Option<PaneId> {
        match tiles.get(tabs.active?)? {
            Tile::Pane(pane) => Some(*pane),
            Tile::Container(_) => None,
        }
    }
}

impl egui_tiles::Behavior<PaneId> for Behavior<'_> {
    fn tab_title_for_pane(&mut self, pane: &PaneId) -> egui::WidgetText {
        pane.entry().title.into()
    }

    fn pane_ui(&mut self, ui: &mut egui::Ui, _: TileId, pane: &mut PaneId) -> UiResponse {
        egui::Frame::new()
            .inner_margin(egui::Margin::same(4))
            .show(ui, |ui| self.app.pane(ui, *pane));
        UiResponse::None
    }

    fn on_tab_button(
        &mut self,
        tiles: &mut egui_tiles::Tiles<PaneId>,
        tile: TileId,
        response: egui::Response,
    ) -> egui::Response {
        if response.double_clicked()
            && let Some(Tile::Pane(pane)) = tiles.get(tile)
        {
            self.app.maximize(*pane);
        }
        response
    }

    fn top_bar_right_ui(
        &mut self,
        tiles: &egui_tiles::Tiles<PaneId>,
        ui: &mut egui::Ui,
        _: TileId,
        tabs: &egui_tiles::Tabs,
        _: &mut f32,
    ) {
        if let Some(pane) = Self::active(tiles, tabs) {
            let name = format!("Maximize {}", pane.entry().title);
            if ui.add(IconButton::new(icons::MAXIMIZE, &name)).clicked() {
                self.app.maximize(pane);
            }
            self.app.controls(ui, pane);
        }
    }

    fn tab_bar_color(&self, visuals: &egui::Visuals) -> egui::Color32 {
        visuals.extreme_bg_color
    }

    fn tab_bar_height(&self, _: &egui::Style) -> f32 {
        TITLE_ROW
    }

    fn simplification_options(&self) -> SimplificationOptions {
        places::simplification()
    }
}
