//! What the 3D view shows.

use super::cut::Cut;
use crate::present::overlay::{COLORINGS, Coloring, Filter, Focus, Outside, Visited};

/// The depth that cells are shown to at first: at most 64 cells, which can be told apart.
pub const FIRST_DEPTH: u32 = 6;

/// Which cells of the tree are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    None,
    /// Those at this depth, and the leaves above it.
    ToDepth(u32),
    /// All leaves that pass the filter.
    All,
    /// The leaves that the selected ray visited.
    Visited,
}

/// What the 3D view shows.
#[derive(Clone, Copy)]
pub struct Settings {
    pub scene: bool,
    pub cells: Cells,
    pub coloring: &'static Coloring,
    pub filter: Filter,
    /// How cells outside of the selected subtree are shown.
    pub outside: Outside,
    /// The root of that subtree, if it stands out.
    pub focus: Option<u32>,
    /// What is hidden of objects and cells.
    pub cut: Cut,
    /// Whether moving the view moves the picture's camera.
    pub linked: bool,
    /// Whether all rays of the picked pixel are drawn, or only the selected one.
    pub all_rays: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            scene: true,
            cells: Cells::ToDepth(FIRST_DEPTH),
            coloring: &COLORINGS[0],
            filter: Filter::default(),
            outside: Outside::default(),
            focus: None,
            cut: Cut::default(),
            linked: false,
            all_rays: true,
        }
    }
}

impl Settings {
    /// Shows these cells, or all leaves if they are shown already.
    pub fn toggle(&mut self, cells: Cells) {
        self.cells = if self.cells == cells {
            Cells::All
        } else {
            cells
        };
    }

    /// Shows no cells, or those of the first depth.
    pub fn toggle_cells(&mut self) {
        self.cells = match self.cells {
            Cells::None => Cells::ToDepth(FIRST_DEPTH),
            _ => Cells::None,
        };
    }

    /// Returns which cells are shown, in a few words.
    pub fn cells_in_words(&self) -> String {
        match (self.cells, self.drawn().to_depth) {
            (Cells::None, _) => "none".to_owned(),
            (Cells::ToDepth(_), Some(depth)) => format!("to depth {depth}"),
            (Cells::ToDepth(_), None) => "filtered".to_owned(),
            (Cells::All, _) => "all".to_owned(),
            (Cells::Visited, _) => "visited".to_owned(),
        }
    }

    pub fn next_visited(&mut self) {
        let visited = &mut self.filter.visited;
        let at = Visited::ALL.iter().position(|v| v == visited);
        *visited = Visited::ALL[(at.unwrap_or(0) + 1) % Visited::ALL.len()];
    }

    pub fn next_outside(&mut self) {
        let at = Outside::ALL.iter().position(|o| *o == self.outside);
        self.outside = Outside::ALL[(at.unwrap_or(0) + 1) % Outside::ALL.len()];
    }

    pub fn next_coloring(&mut self) {
        let at = COLORINGS.iter().position(|c| c.name == self.coloring.name);
        self.coloring = &COLORINGS[(at.unwrap_or(0) + 1) % COLORINGS.len()];
    }

    /// Returns the filter of the boxes that are drawn; those of a ray need none. Filters are about leaves:
    /// with one, leaves are drawn rather than the cells above them. Without a ray, there are no leaves
    /// that it visited: cells are drawn as at first.
    pub fn drawn(&self) -> Filter {
        let all = Filter {
            moment: self.filter.moment,
            ..Filter::default()
        };
        let to_depth = match self.cells {
            Cells::ToDepth(depth) if self.filter == all => Some(depth),
            Cells::Visited if self.filter == all => Some(FIRST_DEPTH),
            _ => None,
        };
        let outside = self.outside;
        let focus = self.focus.map(|node| Focus { node, outside });
        Filter {
            to_depth,
            focus,
            ..self.filter
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filter_of_leaves_shows_leaves() {
        let mut settings = Settings::default();
        assert_eq!(settings.drawn().to_depth, Some(FIRST_DEPTH));
        settings.cells = Cells::Visited;
        assert_eq!(settings.drawn().to_depth, Some(FIRST_DEPTH));
        settings.cells = Cells::ToDepth(3);
        assert_eq!(settings.cells_in_words(), "to depth 3");
        settings.filter.empty = false;
        assert_eq!(settings.drawn().to_depth, None);
        assert_eq!(settings.cells_in_words(), "filtered");
    }

    #[test]
    fn keys_return_to_what_was_shown() {
        let mut settings = Settings::default();
        settings.toggle_cells();
        assert_eq!(settings.cells, Cells::None);
        settings.toggle_cells();
        assert_eq!(settings.cells, Cells::ToDepth(FIRST_DEPTH));
        settings.toggle(Cells::Visited);
        assert_eq!(settings.cells, Cells::Visited);
        settings.toggle(Cells::Visited);
        assert_eq!(settings.cells, Cells::All);
    }
}
