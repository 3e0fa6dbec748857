//! Test for numbers out of range anywhere in a value.

use std::fmt;

use serde::ser::{self, Impossible, Serialize};

/// Returns true if every number with a fraction that a value would write is finite and at most
/// `max` in size.
pub fn numbers_within<T: Serialize + ?Sized>(value: &T, max: f64) -> bool {
    value.serialize(Bounded { max }).is_ok()
}

/// Serializer that writes nothing and fails at a number that is not finite or too large.
#[derive(Debug, Clone, Copy)]
struct Bounded {
    max: f64,
}

/// A number is out of range.
#[derive(Debug)]
struct OutOfRange;

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number is out of range")
    }
}

impl std::error::Error for OutOfRange {}

impl ser::Error for OutOfRange {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self
    }
}

/// Implements the methods for values without numbers that may be infinite.
macro_rules! pass {
    ($($method:ident($($of:ty),*);)*) => {$(
        fn $method(self, $(_: $of),*) -> Result<(), OutOfRange> {
            Ok(())
        }
    )*};
}

/// Implements the methods that begin a compound.
macro_rules! begin {
    ($($method:ident($($of:ty),*) -> $compound:ident;)*) => {$(
        fn $method(self, $(_: $of),*) -> Result<Self::$compound, OutOfRange> {
            Ok(self)
        }
    )*};
}

impl ser::Serializer for Bounded {
    type Ok = ();
    type Error = OutOfRange;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Impossible<(), OutOfRange>;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    fn serialize_f32(self, x: f32) -> Result<(), OutOfRange> {
        self.serialize_f64(f64::from(x))
    }

    fn serialize_f64(self, x: f64) -> Result<(), OutOfRange> {
        if x.abs() <= self.max { Ok(()) } else { Err(OutOfRange) }
    }

    pass! {
        serialize_bool(bool);
        serialize_i8(i8);
        serialize_i16(i16);
        serialize_i32(i32);
        serialize_i64(i64);
        serialize_u8(u8);
        serialize_u16(u16);
        serialize_u32(u32);
        serialize_u64(u64);
        serialize_char(char);
        serialize_str(&str);
        serialize_bytes(&[u8]);
        serialize_none();
        serialize_unit();
        serialize_unit_struct(&'static str);
        serialize_unit_variant(&'static str, u32, &'static str);
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), OutOfRange> {
        value.serialize(self)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Result<(), OutOfRange> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        value: &T,
    ) -> Result<(), OutOfRange> {
        value.serialize(self)
    }

    begin! {
        serialize_seq(Option<usize>) -> SerializeSeq;
        serialize_tuple(usize) -> SerializeTuple;
        serialize_tuple_struct(&'static str, usize) -> SerializeTupleStruct;
        serialize_tuple_variant(&'static str, u32, &'static str, usize) -> SerializeTupleVariant;
        serialize_struct(&'static str, usize) -> SerializeStruct;
        serialize_struct_variant(&'static str, u32, &'static str, usize) -> SerializeStructVariant;
    }

    /// States have no maps, whose order would have no meaning.
    fn serialize_map(self, _: Option<usize>) -> Result<Self::SerializeMap, OutOfRange> {
        Err(OutOfRange)
    }
}

/// Implements a compound by its elements.
macro_rules! compound {
    ($($name:ident $method:ident($($key:ty),*);)*) => {$(
        impl ser::$name for Bounded {
            type Ok = ();
            type Error = OutOfRange;

            fn $method<T: Serialize + ?Sized>(&mut self, $(_: $key,)* value: &T) -> Result<(), OutOfRange> {
                value.serialize(*self)
            }

            fn end(self) -> Result<(), OutOfRange> {
                Ok(())
            }
        }
    )*};
}

compound! {
    SerializeSeq serialize_element();
    SerializeTuple serialize_element();
    SerializeTupleStruct serialize_field();
    SerializeTupleVariant serialize_field();
    SerializeStruct serialize_field(&'static str);
    SerializeStructVariant serialize_field(&'static str);
}

#[cfg(test)]
mod tests {
    use glam::{DQuat, DVec3};

    use super::numbers_within;

    fn is_finite(value: &impl serde::Serialize) -> bool {
        numbers_within(value, f64::MAX)
    }

    #[test]
    fn numbers_are_found_in_every_kind_of_value() {
        let good = (1u8, vec![(DVec3::X, Some(DQuat::IDENTITY))], [2.0f32], "text", Ok::<f64, f64>(1.0));
        assert!(is_finite(&good));
        assert!(!is_finite(&vec![DVec3::new(0.0, f64::NAN, 0.0)]));
        assert!(!is_finite(&(1, Some(DQuat::from_xyzw(0.0, 0.0, f64::INFINITY, 1.0)))));
        assert!(!is_finite(&[f32::NEG_INFINITY]));
        assert!(numbers_within(&(1e3, -1e3, u64::MAX), 1e3) && !numbers_within(&[1.0, -1001.0], 1e3));
        assert!(!is_finite(&Err::<f64, f64>(f64::NAN)));
    }
}
