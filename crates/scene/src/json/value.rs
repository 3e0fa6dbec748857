//! JSON values, with errors in the words of JSON: a number, a text, a list.

use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;

use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::printable::{printable, shown};

/// JSON value as a message names it.
pub enum Found<'a> {
    Null,
    Bool(bool),
    Number(f64),
    Text(&'a str),
    List,
    Object,
}

impl fmt::Display for Found<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Found::Null => f.write_str("null"),
            Found::Bool(x) => write!(f, "{x}"),
            Found::Number(x) => write!(f, "{x}"),
            Found::Text(x) => write!(f, "the text \"{}\"", shown(x)),
            Found::List => f.write_str("a list"),
            Found::Object => f.write_str("an object"),
        }
    }
}

/// Kind of value that a field has. It refuses every value that it does not turn into its own type.
pub trait Kind: Sized {
    type Out;

    /// Kind of value in a message, after *expected*.
    fn expected(&self) -> String;

    fn number(&self, _: f64) -> Option<Self::Out> {
        None
    }

    fn text(&self, _: &str) -> Option<Self::Out> {
        None
    }

    fn flag(&self, _: bool) -> Option<Self::Out> {
        None
    }

    fn null(&self) -> Option<Self::Out> {
        None
    }

    fn list<'de, A: SeqAccess<'de>>(&self, _: A) -> Result<Self::Out, A::Error> {
        Err(refusal(self, &Found::List))
    }

    fn object<'de, A: MapAccess<'de>>(&self, _: A) -> Result<Self::Out, A::Error> {
        Err(refusal(self, &Found::Object))
    }
}

/// Error about a value, which follows the name of its field.
fn refusal<E: Error>(kind: &impl Kind, found: &Found) -> E {
    let is_quoted = match found {
        Found::Text(text) => text.parse::<f64>().is_ok_and(|x| x.is_finite() && kind.number(x).is_some()),
        _ => false,
    };
    let hint = if is_quoted { ", without quotation marks" } else { "" };
    E::custom(format!("is {found}, expected {}{hint}", kind.expected()))
}

/// Seed and visitor of a value.
pub struct Value<K>(pub K);

impl<K: Kind> Value<K> {
    fn take<E: Error>(&self, out: Option<K::Out>, found: &Found) -> Result<K::Out, E> {
        out.ok_or_else(|| refusal(&self.0, found))
    }
}

impl<'de, K: Kind> DeserializeSeed<'de> for Value<K> {
    type Value = K::Out;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<K::Out, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de, K: Kind> Visitor<'de> for Value<K> {
    type Value = K::Out;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.expected())
    }

    fn visit_bool<E: Error>(self, x: bool) -> Result<K::Out, E> {
        self.take(self.0.flag(x), &Found::Bool(x))
    }

    fn visit_i64<E: Error>(self, x: i64) -> Result<K::Out, E> {
        self.visit_f64(x as f64)
    }

    fn visit_u64<E: Error>(self, x: u64) -> Result<K::Out, E> {
        self.visit_f64(x as f64)
    }

    fn visit_f64<E: Error>(self, x: f64) -> Result<K::Out, E> {
        self.take(self.0.number(x), &Found::Number(x))
    }

    fn visit_str<E: Error>(self, x: &str) -> Result<K::Out, E> {
        self.take(self.0.text(x), &Found::Text(x))
    }

    fn visit_unit<E: Error>(self) -> Result<K::Out, E> {
        self.take(self.0.null(), &Found::Null)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<K::Out, A::Error> {
        self.0.list(list)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<K::Out, A::Error> {
        self.0.object(map)
    }
}

/// Number.
pub struct Number;

impl Kind for Number {
    type Out = f64;

    fn expected(&self) -> String {
        "a number".into()
    }

    fn number(&self, x: f64) -> Option<f64> {
        Some(x)
    }
}

/// Number along the vertical, where other formats have a vector.
pub struct Gravity;

impl Kind for Gravity {
    type Out = f64;

    fn expected(&self) -> String {
        "one number: the acceleration downwards, such as 9.81 m/s²".into()
    }

    fn number(&self, x: f64) -> Option<f64> {
        Some(x)
    }
}

/// Whole number of 32 bits.
pub struct Whole;

impl Kind for Whole {
    type Out = u32;

    fn expected(&self) -> String {
        format!("a whole number from 0 to {}", u32::MAX)
    }

    fn number(&self, x: f64) -> Option<u32> {
        (x.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&x)).then_some(x as u32)
    }
}

/// True or false.
pub struct Flag;

impl Kind for Flag {
    type Out = bool;

    fn expected(&self) -> String {
        "true or false".into()
    }

    fn flag(&self, x: bool) -> Option<bool> {
        Some(x)
    }
}

/// Text, cleaned for display.
pub struct Text {
    /// Maximum length, bytes.
    pub max: usize,
}

impl Kind for Text {
    type Out = String;

    fn expected(&self) -> String {
        format!("a text of at most {} characters", self.max)
    }

    fn text(&self, x: &str) -> Option<String> {
        (x.len() <= self.max).then(|| printable(x))
    }
}

/// Word of a type, whose error of parsing lists all of them.
pub struct Word<T>(pub PhantomData<T>);

impl<T: FromStr<Err: fmt::Display>> Kind for Word<T> {
    type Out = T;

    fn expected(&self) -> String {
        // No word is empty.
        let error = "".parse::<T>().err().map_or(String::new(), |e| e.to_string());
        error.trim_start_matches("expected ").to_owned()
    }

    fn text(&self, x: &str) -> Option<T> {
        x.parse().ok()
    }
}

/// List of `N` numbers.
pub struct Numbers<const N: usize> {
    /// Meaning of the numbers, in a message.
    pub meaning: &'static str,
}

impl<const N: usize> Kind for Numbers<N> {
    type Out = [f64; N];

    fn expected(&self) -> String {
        format!("a list of {N} numbers: {}", self.meaning)
    }

    fn list<'de, A: SeqAccess<'de>>(&self, mut list: A) -> Result<[f64; N], A::Error> {
        let mut numbers = [0.0; N];
        let mut count = 0;
        while count < N {
            let Some(x) = list.next_element_seed(Value(Number))? else { break };
            numbers[count] = x;
            count += 1;
        }
        if count == N {
            while list.next_element::<IgnoredAny>()?.is_some() {
                count += 1;
            }
        }
        if count == N {
            return Ok(numbers);
        }
        let plural = if count == 1 { "" } else { "s" };
        Err(Error::custom(format!("has {count} number{plural}, expected {N}: {}", self.meaning)))
    }
}

/// A value, or null where it is unknown.
pub struct Optional<K>(pub K);

impl<K: Kind> Kind for Optional<K> {
    type Out = Option<K::Out>;

    fn expected(&self) -> String {
        self.0.expected()
    }

    fn number(&self, x: f64) -> Option<Self::Out> {
        self.0.number(x).map(Some)
    }

    fn text(&self, x: &str) -> Option<Self::Out> {
        self.0.text(x).map(Some)
    }

    fn null(&self) -> Option<Self::Out> {
        Some(None)
    }

    fn list<'de, A: SeqAccess<'de>>(&self, list: A) -> Result<Self::Out, A::Error> {
        self.0.list(list).map(Some)
    }
}
