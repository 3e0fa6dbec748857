//! Columns of whole numbers as bits, in the code of Golomb and Rice: few bits for a column whose
//! numbers are of like size.
//!
//! R. F. Rice, "Some practical universal noiseless coding techniques", JPL publication 79-22, 1979.

use crate::record::bytes::{Reader, Writer, unzigzag, zigzag};
use crate::record::error::RecordError;

/// Number of ones from which a number follows with all its bits.
const ESCAPE: u32 = 24;
/// Parameter of a column of zeros, which has no bits.
const ZEROS: u8 = 0xff;
/// Bits of a number that follows with all of them.
const WHOLE: u32 = 64;

/// Writes a column: a byte for the parameter, then the bits, filled up to a byte.
pub fn write_column(writer: &mut Writer, column: &[i64]) {
    let values: Vec<u64> = column.iter().map(|value| zigzag(*value)).collect();
    if values.iter().all(|value| *value == 0) {
        writer.byte(ZEROS);
        return;
    }
    let size = |parameter: &u32| values.iter().map(|value| length(*value, *parameter)).sum::<u64>();
    let parameter = (0..WHOLE).min_by_key(size).unwrap_or_default();
    writer.byte(parameter as u8);
    let mut bits = BitWriter::default();
    for value in values {
        let ones = value >> parameter;
        if ones < u64::from(ESCAPE) {
            bits.push((1 << ones) - 1, ones as u32 + 1);
            bits.push(value & ((1 << parameter) - 1), parameter);
        } else {
            bits.push((1 << ESCAPE) - 1, ESCAPE);
            bits.push(value, WHOLE);
        }
    }
    writer.0.extend(bits.bytes);
}

/// Reads a column of `count` numbers.
pub fn read_column(reader: &mut Reader, count: usize) -> Result<Vec<i64>, RecordError> {
    let parameter = match reader.byte()? {
        ZEROS => return Ok(vec![0; count]),
        parameter if u32::from(parameter) < WHOLE => u32::from(parameter),
        _ => return Err(reader.damaged()),
    };
    let mut bits = BitReader { reader, byte: 0, left: 0 };
    let mut column = Vec::new();
    for _ in 0..count {
        let mut ones = 0;
        while ones < ESCAPE && bits.take(1)? == 1 {
            ones += 1;
        }
        let value = if ones == ESCAPE {
            bits.take(WHOLE)?
        } else {
            let high = u64::from(ones) << parameter;
            if high >> parameter != u64::from(ones) {
                return Err(bits.reader.damaged());
            }
            high | bits.take(parameter)?
        };
        column.push(unzigzag(value));
    }
    Ok(column)
}

/// Number of bits of a value.
fn length(value: u64, parameter: u32) -> u64 {
    let ones = value >> parameter;
    if ones < u64::from(ESCAPE) { ones + 1 + u64::from(parameter) } else { u64::from(ESCAPE + WHOLE) }
}

/// Bits, the lowest of a number and of a byte first.
#[derive(Default)]
struct BitWriter {
    bytes: Vec<u8>,
    /// Bits of the last byte that are used, 0 where it is full.
    used: u32,
}

impl BitWriter {
    fn push(&mut self, value: u64, count: u32) {
        for k in 0..count {
            if self.used == 0 {
                self.bytes.push(0);
            }
            if let Some(last) = self.bytes.last_mut() {
                *last |= ((value >> k & 1) as u8) << self.used;
            }
            self.used = (self.used + 1) % 8;
        }
    }
}

struct BitReader<'r, 'a> {
    reader: &'r mut Reader<'a>,
    byte: u8,
    /// Bits of the byte that are not read yet.
    left: u32,
}

impl BitReader<'_, '_> {
    fn take(&mut self, count: u32) -> Result<u64, RecordError> {
        let mut value = 0;
        for k in 0..count {
            if self.left == 0 {
                (self.byte, self.left) = (self.reader.byte()?, 8);
            }
            value |= u64::from(self.byte & 1) << k;
            self.byte >>= 1;
            self.left -= 1;
        }
        Ok(value)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn round_trip(column: &[i64]) -> usize {
        let mut writer = Writer::default();
        write_column(&mut writer, column);
        let mut reader = Reader::new(&writer.0, "a column");
        assert_eq!(read_column(&mut reader, column.len()).as_deref(), Ok(column));
        reader.end().unwrap();
        writer.0.len()
    }

    proptest! {
        #[test]
        fn columns_come_back_as_they_were(scale in 0u32..64, values in prop::collection::vec(any::<i64>(), 0..80)) {
            round_trip(&values.iter().map(|value| value >> scale).collect::<Vec<_>>());
            round_trip(&values);
        }

        #[test]
        fn bytes_that_are_no_column_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..60), count in 0usize..100) {
            let _ = read_column(&mut Reader::new(&bytes, "a column"), count);
        }
    }

    #[test]
    fn a_column_takes_about_its_entropy() {
        let mut random = teeter_scene::Random::new(3);
        let column: Vec<i64> = (0..2000).map(|_| (40.0 * random.normal()).round() as i64).collect();
        // The entropy of a normal distribution of standard deviation 40 is log2(40 sqrt(2 pi e)).
        let entropy = libm::log2(40.0 * (std::f64::consts::TAU * std::f64::consts::E).sqrt()) / 8.0;
        let bytes = round_trip(&column) as f64 / 2000.0;
        assert!(bytes > entropy - 0.02 && bytes < entropy + 0.08, "{bytes} bytes a number, entropy {entropy}");
    }

    #[test]
    fn a_column_of_zeros_takes_a_byte_and_one_far_number_does_not_spoil_the_others() {
        assert_eq!(round_trip(&[0; 50]), 1);
        let mut column = [1; 50];
        column[7] = i64::MIN;
        assert!(round_trip(&column) < 32);
    }
}
