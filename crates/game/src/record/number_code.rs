//! Columns of numbers as bytes: differences from what is expected of them where they are short
//! decimal fractions, else as they are. Every bit comes back.

use crate::record::bytes::{Reader, Writer, multiple};
use crate::record::error::RecordError;
use crate::record::rice_code::{read_column, write_column};

/// Parts of a unit that numbers may be multiples of, the coarsest first: kinds of columns.
const PARTS: [f64; 3] = [1e4, 1e5, 1e6];
/// Kinds of columns: all numbers are as expected; they are written as they are.
const EXPECTED: u8 = 3;
const AS_THEY_ARE: u8 = 4;

/// Numbers that a column is coded against.
#[derive(Debug, Clone, Copy)]
pub struct Expected<'a> {
    /// As many as the column has numbers.
    pub numbers: &'a [f64],
    /// Order in which a difference is like the one before; none where each is of its own.
    pub order: Option<&'a [usize]>,
}

impl Expected<'_> {
    /// The expected numbers in parts.
    fn in_parts(&self, parts: f64) -> impl Iterator<Item = i64> {
        self.numbers.iter().map(move |number| (number * parts).round() as i64)
    }
}

/// Writes a column of as many numbers as are expected.
pub fn write_numbers(writer: &mut Writer, numbers: &[f64], expected: Expected) {
    let bits = |numbers: &[f64]| numbers.iter().map(|number| number.to_bits()).collect::<Vec<u64>>();
    if bits(numbers) == bits(expected.numbers) {
        writer.byte(EXPECTED);
        return;
    }
    let in_parts = |parts: &f64| numbers.iter().map(|number| multiple(*number, *parts)).collect::<Option<Vec<i64>>>();
    let multiples = (0..).zip(&PARTS).find_map(|(kind, parts)| in_parts(parts).map(|column| (kind, *parts, column)));
    let Some((kind, parts, column)) = multiples else {
        writer.byte(AS_THEY_ARE);
        numbers.iter().for_each(|number| writer.0.extend(number.to_le_bytes()));
        return;
    };
    writer.byte(kind);
    let mut left: Vec<i64> = column.iter().zip(expected.in_parts(parts)).map(|(k, e)| k.wrapping_sub(e)).collect();
    if let Some(order) = expected.order {
        let ordered: Vec<i64> = order.iter().map(|index| left[*index]).collect();
        left = differences(&ordered);
    }
    write_column(writer, &left);
}

/// Reads a column of as many numbers as are expected.
pub fn read_numbers(reader: &mut Reader, expected: Expected) -> Result<Vec<f64>, RecordError> {
    let count = expected.numbers.len();
    let kind = reader.byte()?;
    if kind == EXPECTED {
        return Ok(expected.numbers.to_vec());
    }
    if kind == AS_THEY_ARE {
        return (0..count).map(|_| reader.array().map(f64::from_le_bytes)).collect();
    }
    let parts = *PARTS.get(usize::from(kind)).ok_or(reader.damaged())?;
    let mut left = read_column(reader, count)?;
    if let Some(order) = expected.order {
        let ordered = sums(&left);
        order.iter().zip(ordered).for_each(|(index, value)| left[*index] = value);
    }
    let numbers = left.iter().zip(expected.in_parts(parts)).map(|(k, e)| k.wrapping_add(e) as f64 / parts);
    Ok(numbers.collect())
}

/// Writes a column of numbers that are alike: one of them, then the differences from it.
pub fn write_alike(writer: &mut Writer, numbers: &[f64]) {
    if numbers.is_empty() {
        return;
    }
    let typical = median(numbers);
    writer.number(typical);
    write_numbers(writer, numbers, Expected { numbers: &vec![typical; numbers.len()], order: None });
}

/// Reads a column of `count` numbers that are alike.
pub fn read_alike(reader: &mut Reader, count: usize) -> Result<Vec<f64>, RecordError> {
    if count == 0 {
        return Ok(Vec::new());
    }
    let typical = reader.number()?;
    read_numbers(reader, Expected { numbers: &vec![typical; count], order: None })
}

/// Middle of some numbers in their order; zero where there is none.
pub fn median(numbers: &[f64]) -> f64 {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}

/// Differences of each number from the one before.
pub fn differences(numbers: &[i64]) -> Vec<i64> {
    let before = std::iter::once(&0).chain(numbers);
    numbers.iter().zip(before).map(|(now, before)| now.wrapping_sub(*before)).collect()
}

/// Numbers of these differences.
pub fn sums(differences: &[i64]) -> Vec<i64> {
    let mut sum = 0i64;
    let next = |difference: &i64| {
        sum = sum.wrapping_add(*difference);
        sum
    };
    differences.iter().map(next).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn round_trip(numbers: &[f64], expected: &[f64], order: Option<&[usize]>) -> usize {
        let expected = Expected { numbers: expected, order };
        let mut writer = Writer::default();
        write_numbers(&mut writer, numbers, expected);
        let mut reader = Reader::new(&writer.0, "a column");
        let read = read_numbers(&mut reader, expected).unwrap();
        reader.end().unwrap();
        let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&read), bits(numbers));
        writer.0.len()
    }

    proptest! {
        #[test]
        fn numbers_come_back_with_their_bits(
            pairs in prop::collection::vec((any::<f64>(), any::<f64>()), 0..30),
            steps in prop::collection::vec((-3_000_000i64..3_000_000, -2.0f64..2.0), 1..30),
            parts in prop::sample::select(vec![1e4, 1e5, 1e6]),
        ) {
            let (numbers, expected): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
            round_trip(&numbers, &expected, None);
            let numbers: Vec<f64> = steps.iter().map(|(k, _)| *k as f64 / parts).collect();
            let expected: Vec<f64> = steps.iter().map(|(_, e)| *e).collect();
            let order: Vec<usize> = (0..numbers.len()).rev().collect();
            round_trip(&numbers, &expected, Some(&order));
        }
    }

    #[test]
    fn numbers_near_what_is_expected_take_few_bits_and_those_that_are_it_none() {
        let expected = vec![0.025; 40];
        assert_eq!(round_trip(&expected, &expected, None), 1);
        let near: Vec<f64> = (0..40).map(|k| f64::from(25_000 + k % 7 - 3) / 1e6).collect();
        assert!(round_trip(&near, &expected, None) < 2 + 40 / 2);
    }
}
