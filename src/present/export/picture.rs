//! A picture as the bytes of a file.

use crate::trace::Picture;
use image::{DynamicImage, ImageError, ImageFormat, Rgb32FImage, RgbImage};
use std::io::Cursor;

/// The bytes of a picture's file: linear 32-bit float for OpenEXR, else 8-bit sRGB.
///
/// # Errors
/// Those of the encoder.
///
/// # Panics
/// If the picture has not as many pixels as its size says.
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

/// The bytes of a PNG file.
///
/// # Errors
/// Those of the encoder.
pub fn png(image: &RgbImage) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, ImageFormat::Png)?;
    Ok(bytes.into_inner())
}
