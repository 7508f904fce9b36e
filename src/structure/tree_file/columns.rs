//! The arrays of a file.

use super::error::TreeFileError;
use super::header::{Array, Header, Number};

/// The data of a file with the header that describes them. Memory for an array is only taken after its size
/// is known to be that of bytes in the file.
pub struct Columns<'a> {
    pub header: &'a Header,
    pub data: &'a [u8],
}

impl<'a> Columns<'a> {
    /// Returns the entry of an array, `None` if there is none.
    fn entry(&self, name: &str) -> Option<&'a Array> {
        self.header.arrays.iter().find(|array| array.0 == name)
    }

    /// Returns the type and the bytes of an array, one row after the other. `rows` is the number of rows
    /// that it must have, if that is known, and `columns` the numbers per row.
    fn bytes(
        &self,
        name: &'static str,
        rows: Option<usize>,
        columns: usize,
        types: &[Number],
    ) -> Result<(Number, &'a [u8]), TreeFileError> {
        let failed = |reason: String| TreeFileError::Array { name, reason };
        let Some((_, number, shape, offset)) = self.entry(name) else {
            return Err(failed("missing".into()));
        };
        if !types.contains(number) {
            return Err(failed(
                format!("expected {types:?}, found {number:?}").to_lowercase(),
            ));
        }
        let is_shaped = match (shape.as_slice(), columns) {
            (&[found], 1) => rows.is_none_or(|rows| rows as u64 == found),
            (&[found, per_row], _) => {
                rows.is_none_or(|rows| rows as u64 == found) && per_row == columns as u64
            }
            _ => false,
        };
        if !is_shaped {
            let rows = rows.map_or("any number of".into(), |rows| rows.to_string());
            let expected = format!("expected {rows} rows of {columns}");
            return Err(failed(format!("{expected}, found the shape {shape:?}")));
        }
        let bytes = shape
            .iter()
            .try_fold(number.bytes() as u64, |all, &n| all.checked_mul(n));
        let range =
            bytes.and_then(|bytes| Some(*offset as usize..offset.checked_add(bytes)? as usize));
        let part = range.and_then(|range| self.data.get(range));
        part.map(|part| (*number, part))
            .ok_or_else(|| failed("extends beyond the end of the file".into()))
    }

    /// Returns an array of bytes.
    pub fn u8s(&self, name: &'static str, rows: Option<usize>) -> Result<&'a [u8], TreeFileError> {
        Ok(self.bytes(name, rows, 1, &[Number::U8])?.1)
    }

    /// Returns an array of bytes that need not exist.
    pub fn optional_u8s(
        &self,
        name: &'static str,
        rows: usize,
    ) -> Result<Option<&'a [u8]>, TreeFileError> {
        let found = self.entry(name).map(|_| self.u8s(name, Some(rows)));
        found.transpose()
    }

    /// Returns an array of integers.
    pub fn u32s(&self, name: &'static str, rows: Option<usize>) -> Result<Vec<u32>, TreeFileError> {
        let (_, bytes) = self.bytes(name, rows, 1, &[Number::U32])?;
        let (numbers, _) = bytes.as_chunks();
        Ok(numbers.iter().map(|&n| u32::from_le_bytes(n)).collect())
    }

    /// Returns an array of `f32`.
    pub fn f32s(&self, name: &'static str, rows: usize) -> Result<Vec<f32>, TreeFileError> {
        let (_, bytes) = self.bytes(name, Some(rows), 1, &[Number::F32])?;
        let (numbers, _) = bytes.as_chunks();
        Ok(numbers.iter().map(|&n| f32::from_le_bytes(n)).collect())
    }

    /// Returns rows of six numbers, and whether they are in `f32`.
    pub fn sixes(
        &self,
        name: &'static str,
        rows: usize,
    ) -> Result<(Vec<[f64; 6]>, bool), TreeFileError> {
        let (number, bytes) = self.bytes(name, Some(rows), 6, &[Number::F32, Number::F64])?;
        let mut numbers: Vec<f64> = Vec::with_capacity(6 * rows);
        if number == Number::F32 {
            let (all, _) = bytes.as_chunks();
            numbers.extend(all.iter().map(|&n| f64::from(f32::from_le_bytes(n))));
        } else {
            let (all, _) = bytes.as_chunks();
            numbers.extend(all.iter().map(|&n| f64::from_le_bytes(n)));
        }
        let (sixes, _) = numbers.as_chunks();
        Ok((sixes.to_vec(), number == Number::F32))
    }
}
