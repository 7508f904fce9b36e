//! Encodes a picture as a file.

use crate::trace::Picture;
use image::{DynamicImage, ImageError, ImageFormat, Rgb32FImage, RgbImage};
use std::io::Cursor;

/// Encodes a picture: as linear 32-bit floats for OpenEXR, otherwise as 8-bit sRGB.
///
/// # Errors
/// Errors of the encoder.
///
/// # Panics
/// If the number of pixels does not match the picture's size.
pub fn encoded(picture: &Picture, format: ImageFormat) -> Result<Vec<u8>, ImageError> {
    let (width, height) = (picture.width, picture.height);
    let image = if format == ImageFormat::OpenExr {
        Rgb32FImage::from_raw(width, height, picture.pixels().concat())
            .map(DynamicImage::ImageRgb32F)
    } else {
        RgbImage::from_raw(width, height, picture.to_srgb8().concat()).map(DynamicImage::ImageRgb8)
    };
    let mut bytes = Cursor::new(Vec::new());
    image
        .expect("as many pixels as the size says")
        .write_to(&mut bytes, format)?;
    Ok(bytes.into_inner())
}

/// Encodes a picture as a PNG file.
///
/// # Errors
/// Errors of the encoder.
pub fn png(image: &RgbImage) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, ImageFormat::Png)?;
    Ok(bytes.into_inner())
}
