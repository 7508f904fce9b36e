//! Loads the buffers: from the file, from data URIs, or from files in the same folder.

use super::extensions::compressed;
use super::json::Root;
use crate::progress::Progress;
use crate::scene::format::error::ReadError;
use crate::scene::format::input::{Input, MAX_BYTES, SiblingError};
use crate::scene::format::lines::quoted;
use crate::scene::format::place::Place;
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::percent_decode_str;
use std::borrow::Cow;

/// Writers differ in whether they pad the end.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Returns the bytes of every buffer; at most [`MAX_BYTES`] in total.
pub(super) fn load<'a>(
    root: &Root,
    binary: Option<&'a [u8]>,
    input: &Input<'_>,
    progress: &Progress,
) -> Result<Vec<Cow<'a, [u8]>>, ReadError> {
    let mut total = 0;
    let mut all = Vec::new();
    for (number, buffer) in root.buffers.iter().enumerate() {
        let place = Place::Element("buffer", number);
        let bytes = match (&buffer.uri, binary) {
            (Some(uri), _) => Cow::Owned(of_uri(uri, place, input, progress)?),
            (None, Some(binary)) if number == 0 => Cow::Borrowed(binary),
            (None, _) => {
                let expected = "a URI, or the binary chunk of a GLB";
                let error = compressed(buffer.extensions.keys(), place);
                return Err(error.unwrap_or_else(|| ReadError::at(place, expected, "neither")));
            }
        };
        let declared = buffer.byte_length.0;
        if (bytes.len() as u64) < declared {
            let expected = format_args!("{declared} bytes");
            return Err(ReadError::at(place, expected, bytes.len()));
        }
        total += bytes.len() as u64;
        if total > MAX_BYTES {
            let expected = format_args!("at most {MAX_BYTES} bytes in all buffers");
            return Err(ReadError::at(place, expected, total));
        }
        all.push(bytes);
    }
    Ok(all)
}

fn of_uri(
    uri: &str,
    place: Place,
    input: &Input<'_>,
    progress: &Progress,
) -> Result<Vec<u8>, ReadError> {
    if let Some(data) = uri.trim_start().strip_prefix("data:") {
        return of_data(data, place);
    }
    let name = percent_decode_str(uri).decode_utf8_lossy();
    input
        .read_sibling(&name, progress)
        .map_err(|error| match error {
            SiblingError::Cancelled(cancelled) => cancelled.into(),
            error => {
                let expected = format_args!("the file {}", quoted(name.as_bytes()));
                ReadError::at(place, expected, format_args!("none: {error}"))
            }
        })
}

/// Returns the bytes of a data URI (L. Masinter, RFC 2397), given what follows `data:`.
fn of_data(data: &str, place: Place) -> Result<Vec<u8>, ReadError> {
    let Some((kind, text)) = data.split_once(',') else {
        return Err(ReadError::at(place, "a data URI with a comma", "none"));
    };
    let decoded = Cow::from(percent_decode_str(text));
    let is_base64 = kind.trim_end().to_ascii_lowercase().ends_with("base64");
    if !is_base64 {
        return Ok(decoded.into_owned());
    }
    let is_unusual = |b: &u8| b.is_ascii_whitespace() || matches!(b, b'-' | b'_');
    let plain: Cow<'_, [u8]> = if decoded.iter().any(is_unusual) {
        // Line breaks, and the alphabet for URLs.
        let letters = decoded.iter().filter(|b| !b.is_ascii_whitespace());
        let letter = |b: &u8| match b {
            b'-' => b'+',
            b'_' => b'/',
            other => *other,
        };
        letters.map(letter).collect::<Vec<u8>>().into()
    } else {
        decoded
    };
    BASE64
        .decode(&plain)
        .map_err(|error| ReadError::at(place, "base64 in the data URI", error))
}
