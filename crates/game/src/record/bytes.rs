//! Numbers as bytes: variable length for whole numbers, short forms for decimal fractions.

use crate::record::error::RecordError;

/// Decimal fractions that are short: multiples of a micrometre, as a pointer or a recorder rounds.
const FINE: f64 = 1e6;
/// Largest multiple that is written short.
const MAX_MULTIPLE: f64 = 1e9;

/// Writer of bytes.
#[derive(Debug, Default)]
pub struct Writer(pub Vec<u8>);

impl Writer {
    /// Writes a byte.
    pub fn byte(&mut self, byte: u8) {
        self.0.push(byte);
    }

    /// Writes a whole number, seven bits a byte (LEB128).
    pub fn unsigned(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.0.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.0.push(value as u8);
    }

    /// Writes a whole number of either sign: zigzag, so that small ones are short.
    pub fn signed(&mut self, value: i64) {
        self.unsigned(zigzag(value));
    }

    /// Writes a number exactly: as a multiple of a millionth where it is one, else as it is.
    pub fn number(&mut self, value: f64) {
        match multiple(value, FINE) {
            // Zero is kept for numbers that are written as they are.
            Some(k) => self.signed(if k >= 0 { k + 1 } else { k }),
            None => {
                self.signed(0);
                self.0.extend(value.to_le_bytes());
            }
        }
    }

    /// Writes bytes after their number.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.unsigned(bytes.len() as u64);
        self.0.extend(bytes);
    }
}

/// Returns a whole number of either sign as one without: small where it is near zero.
pub fn zigzag(value: i64) -> u64 {
    ((value << 1) ^ (value >> 63)) as u64
}

/// Returns the number of which [`zigzag`] returns `value`.
pub fn unzigzag(value: u64) -> i64 {
    (value >> 1) as i64 ^ -((value & 1) as i64)
}

/// Returns k where `value` is exactly k / `parts`, as a decimal fraction is read.
pub fn multiple(value: f64, parts: f64) -> Option<i64> {
    let k = (value * parts).round();
    let multiple = k as i64;
    (k.abs() <= MAX_MULTIPLE && (multiple as f64 / parts).to_bits() == value.to_bits()).then_some(multiple)
}

/// Reader of bytes. Every method fails where the bytes end early or cannot be what is read.
#[derive(Debug)]
pub struct Reader<'a> {
    bytes: &'a [u8],
    part: &'static str,
}

impl<'a> Reader<'a> {
    /// A reader; `part` names the bytes in errors.
    pub fn new(bytes: &'a [u8], part: &'static str) -> Self {
        Self { bytes, part }
    }

    /// The error of these bytes.
    pub fn damaged(&self) -> RecordError {
        RecordError::Damaged(self.part)
    }

    /// True when all bytes are read.
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// Fails unless all bytes are read.
    pub fn end(&self) -> Result<(), RecordError> {
        if self.is_empty() { Ok(()) } else { Err(self.damaged()) }
    }

    /// Reads a byte.
    pub fn byte(&mut self) -> Result<u8, RecordError> {
        Ok(self.array::<1>()?[0])
    }

    /// Reads a fixed number of bytes.
    pub fn array<const N: usize>(&mut self) -> Result<[u8; N], RecordError> {
        let (array, rest) = self.bytes.split_first_chunk().ok_or(self.damaged())?;
        self.bytes = rest;
        Ok(*array)
    }

    /// Reads a whole number.
    pub fn unsigned(&mut self) -> Result<u64, RecordError> {
        let mut value = 0u64;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            let part = u64::from(byte & 0x7f);
            if part << shift >> shift != part {
                break;
            }
            value |= part << shift;
            if byte < 0x80 {
                return Ok(value);
            }
        }
        Err(self.damaged())
    }

    /// Reads a whole number of 32 bits.
    pub fn index(&mut self) -> Result<u32, RecordError> {
        self.unsigned()?.try_into().map_err(|_| self.damaged())
    }

    /// Reads a whole number of either sign.
    pub fn signed(&mut self) -> Result<i64, RecordError> {
        self.unsigned().map(unzigzag)
    }

    /// Reads a number.
    pub fn number(&mut self) -> Result<f64, RecordError> {
        match self.signed()? {
            0 => Ok(f64::from_le_bytes(self.array()?)),
            k if k > 0 => Ok((k - 1) as f64 / FINE),
            k => Ok(k as f64 / FINE),
        }
    }

    /// Reads bytes after their number.
    pub fn bytes(&mut self) -> Result<&'a [u8], RecordError> {
        let len = usize::try_from(self.unsigned()?).map_err(|_| self.damaged())?;
        let (bytes, rest) = self.bytes.split_at_checked(len).ok_or(self.damaged())?;
        self.bytes = rest;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn numbers_survive_with_their_bits(whole in any::<u64>(), signed in any::<i64>(), bits in any::<u64>(), k in -2_000_000_000i64..2_000_000_000) {
            let number = f64::from_bits(bits);
            let decimal = k as f64 / 1e6;
            let mut writer = Writer::default();
            writer.unsigned(whole);
            writer.signed(signed);
            writer.number(number);
            writer.number(decimal);
            writer.bytes(&[1, 2, 3]);
            let mut reader = Reader::new(&writer.0, "numbers");
            prop_assert_eq!(reader.unsigned(), Ok(whole));
            prop_assert_eq!(reader.signed(), Ok(signed));
            prop_assert_eq!(reader.number().map(f64::to_bits), Ok(bits));
            prop_assert_eq!(reader.number().map(f64::to_bits), Ok(decimal.to_bits()));
            prop_assert_eq!(reader.bytes(), Ok(&[1, 2, 3][..]));
            prop_assert_eq!(reader.end(), Ok(()));
        }
    }

    #[test]
    fn decimal_fractions_are_short_and_negative_zero_is_not_zero() {
        let len = |value: f64| {
            let mut writer = Writer::default();
            writer.number(value);
            assert_eq!(Reader::new(&writer.0, "number").number().map(f64::to_bits), Ok(value.to_bits()));
            writer.0.len()
        };
        assert_eq!((len(0.0), len(1e-5), len(-0.0405), len(0.1 + 0.2)), (1, 1, 3, 9));
        assert_eq!(len(-0.0), 9);
    }

    #[test]
    fn bytes_that_end_early_or_are_too_long_for_a_number_are_refused() {
        assert_eq!(Reader::new(&[0x80], "x").unsigned(), Err(RecordError::Damaged("x")));
        assert_eq!(Reader::new(&[0xff; 12], "x").unsigned(), Err(RecordError::Damaged("x")));
        assert_eq!(Reader::new(&[5, 1, 2], "x").bytes(), Err(RecordError::Damaged("x")));
        assert_eq!(Reader::new(&[0xff, 0xff, 0xff, 0xff, 0x7f], "x").index(), Err(RecordError::Damaged("x")));
    }
}
