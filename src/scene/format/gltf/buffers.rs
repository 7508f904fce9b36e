//! Loads the buffers: from the file, from data URIs, or from files in the same folder.

use crate::progress::Progress;
use crate::scene::format::error::ReadError;
use crate::scene::format::input::{Input, MAX_BYTES, SiblingError};
use crate::scene::format::lines::quoted;
use crate::scene::format::place::Place;
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use gltf_json::Root;
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
                return Err(ReadError::at(place, expected, "neither"));
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
    if let Some(data) = uri.strip_prefix("data:") {
        let Some((_, text)) = data.split_once(";base64,") else {
            return Err(ReadError::at(place, "a data URI in base64", "another"));
        };
        return BASE64
            .decode(text)
            .map_err(|error| ReadError::at(place, "base64", error));
    }
    let name = percent_encoding::percent_decode_str(uri).decode_utf8_lossy();
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
