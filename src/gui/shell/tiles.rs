//! How the tiles of a task show their panes.

use super::app::App;
use super::layout::{self, PaneId};
use crate::gui::icons;
use crate::gui::theme::IconButton;
use egui_tiles::{SimplificationOptions, Tile, TileId, UiResponse};

/// The height of a pane's title row in points.
pub const TITLE_ROW: f32 = 36.0;

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
        layout::simplification()
    }
}
