//! The container: JSON, and the binary chunk of a GLB.

use crate::scene::format::error::ReadError;
use crate::scene::format::place::Place;

/// Bytes at the start and end of a file in which the `asset` key is looked for.
const SNIFFED_BYTES: usize = 1 << 16;

/// What is expected where another version is found.
pub(super) const VERSION_2: &str =
    "glTF version 2 (convert the file, for example by importing and exporting it with Blender)";

/// Returns whether the file is a GLB.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    bytes.starts_with(b"glTF")
}

/// Returns whether the file is a JSON object with the key `asset` near its beginning or end.
pub(super) fn is_json(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let head = &text[..text.len().min(SNIFFED_BYTES)];
    let tail = &text[text.len().saturating_sub(SNIFFED_BYTES)..];
    let names_it = |part: &[u8]| part.windows(7).any(|word| word == b"\"asset\"");
    text.trim_ascii_start().starts_with(b"{") && (names_it(head) || names_it(tail))
}

/// Returns the JSON and, if there is one, the binary chunk.
pub(super) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), ReadError> {
    if !is_binary(bytes) {
        return Ok((bytes, None));
    }
    let version = number(bytes, 4)?;
    if version != 2 {
        let found = format!("glTF {version}.0");
        return Err(ReadError::at(Place::Byte(4), VERSION_2, found));
    }
    let length = number(bytes, 8)? as usize;
    let Some(file) = bytes.get(..length) else {
        let expected = format_args!("{length} bytes, as declared in the header");
        let end = format_args!("{}", bytes.len());
        return Err(ReadError::at(Place::Byte(8), expected, end));
    };
    let (json, end) = chunk(file, 12, *b"JSON")?;
    // Further chunks are extensions and are ignored.
    let binary = if end < file.len() && file.get(end + 4..end + 8) == Some(b"BIN\0") {
        Some(chunk(file, end, *b"BIN\0")?.0)
    } else {
        None
    };
    Ok((json, binary))
}

/// Returns the chunk that begins at a byte offset, and its end.
fn chunk(bytes: &[u8], at: usize, kind: [u8; 4]) -> Result<(&[u8], usize), ReadError> {
    let length = number(bytes, at)? as usize;
    let name = String::from_utf8_lossy(&kind[..]);
    let name = name.trim_end_matches('\0');
    let found = bytes.get(at + 4..at + 8);
    if found != Some(&kind[..]) {
        let expected = format_args!("a chunk '{name}'");
        return Err(ReadError::at(Place::Byte(at + 4), expected, "another"));
    }
    let start = at + 8;
    let end = start.saturating_add(length);
    let Some(chunk) = bytes.get(start..end) else {
        let expected = format_args!("{length} bytes in chunk '{name}'");
        let left = bytes.len() - start;
        return Err(ReadError::at(Place::Byte(at), expected, left));
    };
    Ok((chunk, end))
}

fn number(bytes: &[u8], at: usize) -> Result<u32, ReadError> {
    let four = bytes.get(at..at + 4).and_then(|four| four.try_into().ok());
    four.map(u32::from_le_bytes).ok_or_else(|| {
        let end = Place::Byte(bytes.len());
        ReadError::at(end, "the rest of a GLB header", "the end of the file")
    })
}
