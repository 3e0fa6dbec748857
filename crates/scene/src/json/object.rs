//! JSON objects with known fields: unknown, repeated and missing ones are errors.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};

use super::names::{Known, unknown};
use super::value::Kind;

/// Object with known fields.
pub trait Fields: Default {
    /// Kind of object in a message, with its article, and the names of all fields.
    const KNOWN: Known;
    /// Other kinds of object in the same text.
    const OTHERS: &'static [Known];
    /// Type that the object describes.
    type Out;

    /// Reads the value of a field, by a name of [`Fields::KNOWN`].
    fn read<'de, A: MapAccess<'de>>(&mut self, name: &str, map: &mut A) -> Result<(), A::Error>;

    /// Completes the object when all its fields are read; the error is a message.
    fn complete(self) -> Result<Self::Out, String>;
}

/// Kind of an object with known fields.
pub struct Object<F>(pub PhantomData<F>);

impl<F: Fields> Kind for Object<F> {
    type Out = F::Out;

    fn expected(&self) -> String {
        format!("an object: {}", F::KNOWN.0)
    }

    fn object<'de, A: MapAccess<'de>>(&self, mut map: A) -> Result<F::Out, A::Error> {
        let mut fields = F::default();
        let mut seen = vec![false; F::KNOWN.1.len()];
        while let Some(index) = map.next_key_seed(Key::<F>(PhantomData))? {
            let index = index.map_err(Error::custom)?;
            let name = F::KNOWN.1[index];
            if std::mem::replace(&mut seen[index], true) {
                return Err(Error::custom(format!("field `{name}` is given twice")));
            }
            fields.read(name, &mut map)?;
        }
        fields.complete().map_err(Error::custom)
    }
}

/// Name of a field, as its index in the list, or a message about it. An error of its own would be
/// located at the unknown field, whose name is in the message.
struct Key<F>(PhantomData<F>);

impl<'de, F: Fields> DeserializeSeed<'de> for Key<F> {
    type Value = Result<usize, String>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl<F: Fields> Visitor<'_> for Key<F> {
    type Value = Result<usize, String>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a field of {}", F::KNOWN.0)
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Self::Value, E> {
        let index = F::KNOWN.1.iter().position(|known| *known == name);
        Ok(index.ok_or_else(|| unknown(name, F::KNOWN, F::OTHERS)))
    }
}

/// Value of a field that an object must have.
pub fn required<T>(value: Option<T>, name: &str) -> Result<T, String> {
    value.ok_or_else(|| format!("missing field `{name}`"))
}
