//! The arrays of a file that is written.

use super::header::{ALIGNMENT, Array, Header, Number};
use std::io::{self, Write};

/// Arrays with their bytes.
#[derive(Default)]
pub struct Data {
    arrays: Vec<Array>,
    bytes: Vec<u8>,
}

impl Data {
    /// Adds an array of rows of `columns` numbers, which `bytes` returns in little-endian order.
    pub fn add<const N: usize>(
        &mut self,
        (name, number, columns): (&str, Number, u64),
        bytes: impl Iterator<Item = [u8; N]>,
    ) {
        self.bytes
            .resize(self.bytes.len().next_multiple_of(ALIGNMENT), 0);
        let offset = self.bytes.len();
        self.bytes.extend(bytes.flatten());
        let rows = ((self.bytes.len() - offset) / number.bytes()) as u64 / columns;
        let shape = if columns == 1 {
            vec![rows]
        } else {
            vec![rows, columns]
        };
        self.arrays
            .push((name.to_owned(), number, shape, offset as u64));
    }

    pub fn u8s(&mut self, name: &str, numbers: impl Iterator<Item = u8>) {
        self.add((name, Number::U8, 1), numbers.map(|n| [n]));
    }

    pub fn u32s(&mut self, name: &str, numbers: impl Iterator<Item = u32>) {
        self.add((name, Number::U32, 1), numbers.map(u32::to_le_bytes));
    }

    /// Writes header and arrays.
    ///
    /// # Errors
    /// I/O errors.
    pub fn write(self, header: Header, out: &mut dyn Write) -> io::Result<()> {
        let arrays = self.arrays;
        let mut line = serde_json::to_vec(&Header { arrays, ..header })?;
        line.resize((line.len() + 1).next_multiple_of(ALIGNMENT) - 1, b' ');
        line.push(b'\n');
        out.write_all(&line)?;
        out.write_all(&self.bytes)
    }
}
