//! Images in memory, and the tiles that they are rendered in.

use crate::geometry::Vec3;

/// Edge of a tile in pixels.
pub const TILE: u32 = 32;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

impl Tile {
    /// Returns the number of pixels.
    pub const fn len(&self) -> usize {
        self.width as usize * self.height as usize
    }

    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the coordinates in the image of a pixel of the tile, given by its index row by row.
    pub const fn pixel(&self, index: u32) -> (u32, u32) {
        (self.x + index % self.width, self.y + index / self.width)
    }
}

/// Returns the tiles of an image, row by row.
pub fn tiles(width: u32, height: u32) -> Vec<Tile> {
    let mut tiles = Vec::new();
    for y in (0..height).step_by(TILE as usize) {
        for x in (0..width).step_by(TILE as usize) {
            tiles.push(Tile {
                x,
                y,
                width: TILE.min(width - x),
                height: TILE.min(height - y),
            });
        }
    }
    tiles
}

/// An image of linear colors, row by row from the upper left.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    pub width: u32,
    pub height: u32,
    pixels: Vec<[f32; 3]>,
}

impl Picture {
    /// Returns a black image.
    pub fn new(width: u32, height: u32) -> Self {
        Picture {
            width,
            height,
            pixels: vec![[0.0; 3]; width as usize * height as usize],
        }
    }

    /// Returns the linear colors, row by row.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    /// Returns the linear color of a pixel.
    pub fn get(&self, x: u32, y: u32) -> [f32; 3] {
        self.pixels[(y * self.width + x) as usize]
    }

    /// Adds sample number `sample` of a tile's pixels: each pixel becomes the mean of its samples so far.
    /// Sample 0 replaces the pixels.
    pub fn add_tile(&mut self, tile: &Tile, sample: u32, colors: &[Vec3]) {
        let share = 1.0 / (sample as f32 + 1.0);
        for (row, colors) in colors.chunks_exact(tile.width as usize).enumerate() {
            let start = (tile.y as usize + row) * self.width as usize + tile.x as usize;
            for (pixel, color) in self.pixels[start..].iter_mut().zip(colors) {
                let color = color.as_vec3().to_array();
                for (mean, value) in pixel.iter_mut().zip(color) {
                    *mean = if sample == 0 {
                        value
                    } else {
                        *mean + (value - *mean) * share
                    };
                }
            }
        }
    }

    /// Converts to 8-bit sRGB, row by row (IEC 61966-2-1). Values outside 0 to 1 are clipped.
    pub fn to_srgb8(&self) -> Vec<[u8; 3]> {
        self.pixels.iter().map(|p| p.map(srgb8)).collect()
    }
}

/// Converts a linear value to 8-bit sRGB (IEC 61966-2-1). Values outside 0 to 1 are clipped.
pub fn srgb8(linear: f32) -> u8 {
    let linear = linear.clamp(0.0, 1.0);
    let encoded = if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    };
    (encoded * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_every_pixel_once() {
        for (width, height) in [(1, 1), (33, 64), (100, 7)] {
            let mut seen = vec![0; (width * height) as usize];
            for tile in tiles(width, height) {
                for i in 0..tile.len() as u32 {
                    let (x, y) = tile.pixel(i);
                    seen[(y * width + x) as usize] += 1;
                }
            }
            assert!(seen.iter().all(|&n| n == 1));
        }
    }

    #[test]
    fn srgb_keeps_black_white_and_the_known_middle() {
        assert_eq!(
            [0.0, 1.0, 0.2140, 2.0, -1.0].map(srgb8),
            [0, 255, 127, 255, 0]
        );
    }
}
