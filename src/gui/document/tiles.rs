//! The tiles added to a picture, so that a view uploads only what it has not seen.

use crate::trace::Tile;

/// The most tiles that are remembered: those of some samples of a usual picture.
const MOST: usize = 10_000;

/// The tiles added to a picture, in order. The oldest are forgotten.
#[derive(Default)]
pub struct Tiles {
    forgotten: usize,
    tiles: Vec<Tile>,
}

impl Tiles {
    pub fn push(&mut self, tile: Tile) {
        if self.tiles.len() == MOST {
            self.tiles.drain(..MOST / 2);
            self.forgotten += MOST / 2;
        }
        self.tiles.push(tile);
    }

    /// Returns how many tiles have been added.
    pub fn count(&self) -> usize {
        self.forgotten + self.tiles.len()
    }

    /// Returns the tiles added after the first `seen`; `None` if some of them are forgotten.
    pub fn since(&self, seen: usize) -> Option<&[Tile]> {
        self.tiles.get(seen.checked_sub(self.forgotten)?..)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_gets_the_tiles_it_has_not_seen() {
        let tile = |x| Tile {
            x,
            y: 0,
            width: 1,
            height: 1,
        };
        let mut tiles = Tiles::default();
        assert_eq!(tiles.since(0), Some(&[][..]));
        for x in 0..3 {
            tiles.push(tile(x));
        }
        assert_eq!(tiles.since(1), Some(&[tile(1), tile(2)][..]));
        assert_eq!(tiles.since(3), Some(&[][..]));
        for x in 3..=MOST as u32 {
            tiles.push(tile(x));
        }
        assert_eq!(tiles.count(), MOST + 1);
        assert_eq!(tiles.since(MOST), Some(&[tile(MOST as u32)][..]));
        assert_eq!(tiles.since(3), None);
    }
}
