//! The counts, and optionally the times, of all pixels of a picture.

use crate::trace::{CountedTile, PixelTallies, RayKind, Tally};

/// The most pixels whose counts are kept. A pixel needs about 150 bytes.
pub const PIXEL_COUNTS_LIMIT: u64 = 4_000_000;

/// The counts of all pixels, row by row from the upper left. A pixel needs about 150 bytes.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelCounts {
    pub width: u32,
    pub height: u32,
    pub tallies: Vec<PixelTallies>,
    /// Number of objects that each pixel's primary ray intersects, including hidden ones.
    pub depth_complexity: Vec<u32>,
    /// Time of each pixel; `None` unless measured ([`crate::trace::pixel_times`]).
    pub seconds: Option<Vec<f32>>,
}

impl PixelCounts {
    /// Creates counts of zero.
    pub fn new(width: u32, height: u32) -> Self {
        let pixels = width as usize * height as usize;
        PixelCounts {
            width,
            height,
            tallies: vec![PixelTallies::default(); pixels],
            depth_complexity: vec![0; pixels],
            seconds: None,
        }
    }

    /// Adds the counts of a tile of this picture.
    pub fn add(&mut self, part: &CountedTile) {
        let columns = part.tile.width as usize;
        let rows = part.pixels.chunks_exact(columns);
        let rows = rows.zip(part.depth_complexity.chunks_exact(columns));
        for (row, (tallies, depths)) in rows.enumerate() {
            let start = (part.tile.y as usize + row) * self.width as usize + part.tile.x as usize;
            self.tallies[start..start + columns].copy_from_slice(tallies);
            self.depth_complexity[start..start + columns].copy_from_slice(depths);
        }
    }

    /// Returns the counts of some of a pixel's rays.
    pub fn tally(&self, pixel: usize, rays: RayFilter) -> Tally {
        let tallies = &self.tallies[pixel];
        let kinds = rays.kinds().iter();
        kinds.map(|&kind| tallies[kind as usize]).sum()
    }
}

/// A selection of rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum RayFilter {
    #[default]
    All,
    Primary,
    Shadow,
    /// Reflected and refracted rays.
    Secondary,
    Reflected,
    Refracted,
}

impl RayFilter {
    pub const ALL: [RayFilter; 6] = [
        RayFilter::All,
        RayFilter::Primary,
        RayFilter::Shadow,
        RayFilter::Secondary,
        RayFilter::Reflected,
        RayFilter::Refracted,
    ];

    /// Returns the name in settings. Followed by "rays", it is the display name.
    pub const fn name(self) -> &'static str {
        match self {
            RayFilter::All => "all",
            RayFilter::Primary => "primary",
            RayFilter::Shadow => "shadow",
            RayFilter::Secondary => "secondary",
            RayFilter::Reflected => "reflected",
            RayFilter::Refracted => "refracted",
        }
    }

    /// Returns the selection with this name.
    pub fn named(name: &str) -> Option<RayFilter> {
        RayFilter::ALL.into_iter().find(|f| f.name() == name)
    }

    /// Returns the selected kinds.
    pub const fn kinds(self) -> &'static [RayKind] {
        match self {
            RayFilter::All => &RayKind::ALL,
            RayFilter::Primary => &[RayKind::Primary],
            RayFilter::Shadow => &[RayKind::Shadow],
            RayFilter::Secondary => &[RayKind::Reflected, RayKind::Refracted],
            RayFilter::Reflected => &[RayKind::Reflected],
            RayFilter::Refracted => &[RayKind::Refracted],
        }
    }
}
