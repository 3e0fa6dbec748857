//! Names of the players of a record.

use teeter_scene::is_hidden;

use crate::record::bytes::{Reader, Writer};
use crate::record::error::RecordError;

/// Maximum number of names, and of the characters of a name.
const MAX_NAMES: usize = 8;
const MAX_CHARS: usize = 40;

/// Names of players in the order of their seats, in printable characters.
///
/// ```
/// use teeter_game::PlayerNames;
///
/// let names = PlayerNames::new(["Ada\n", "Grace"]);
/// assert_eq!(names.as_slice(), ["Ada", "Grace"]);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PlayerNames(Vec<String>);

impl PlayerNames {
    /// The first eight names, without control characters, white space at their ends and what is
    /// beyond 40 characters.
    pub fn new<N: AsRef<str>>(names: impl IntoIterator<Item = N>) -> Self {
        Self(names.into_iter().take(MAX_NAMES).map(|name| cleaned(name.as_ref())).collect())
    }

    /// The names.
    pub fn as_slice(&self) -> &[String] {
        &self.0
    }

    /// Writes the names.
    pub(crate) fn write(&self, writer: &mut Writer) {
        writer.unsigned(self.0.len() as u64);
        self.0.iter().for_each(|name| writer.bytes(name.as_bytes()));
    }

    /// Reads names such as [`PlayerNames::new`] makes.
    pub(crate) fn read(reader: &mut Reader) -> Result<Self, RecordError> {
        let damaged = RecordError::Damaged("its names");
        let mut names = Vec::new();
        for _ in 0..reader.unsigned()? {
            let name = std::str::from_utf8(reader.bytes()?).map_err(|_| damaged.clone())?;
            if names.len() == MAX_NAMES || cleaned(name) != name {
                return Err(damaged);
            }
            names.push(name.to_owned());
        }
        Ok(Self(names))
    }
}

fn cleaned(name: &str) -> String {
    let name: String = name.chars().filter(|c| !is_hidden(*c)).collect();
    let name: String = name.trim().chars().take(MAX_CHARS).collect();
    name.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn written(names: &PlayerNames) -> Vec<u8> {
        let mut writer = Writer::default();
        names.write(&mut writer);
        writer.0
    }

    proptest! {
        #[test]
        fn any_names_are_cleaned_and_come_back(names in prop::collection::vec(any::<String>(), 0..12)) {
            let names = PlayerNames::new(&names);
            prop_assert!(names.as_slice().len() <= 8);
            for name in names.as_slice() {
                prop_assert!(name.chars().count() <= 40 && !name.chars().any(char::is_control));
            }
            prop_assert_eq!(PlayerNames::new(names.as_slice()), names.clone());
            let bytes = written(&names);
            let mut reader = Reader::new(&bytes, "its content");
            prop_assert_eq!(PlayerNames::read(&mut reader), Ok(names));
            prop_assert_eq!(reader.end(), Ok(()));
        }

        #[test]
        fn bytes_that_are_no_names_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..60)) {
            let _ = PlayerNames::read(&mut Reader::new(&bytes, "its content"));
        }
    }

    #[test]
    fn names_keep_their_script_and_lose_what_does_not_print() {
        let names = PlayerNames::new(["  Åsa \u{202e}evil\u{7}", "千歳", &"x".repeat(60), ""]);
        assert_eq!(names.as_slice(), ["Åsa evil", "千歳", &"x".repeat(40), ""]);
    }

    #[test]
    fn names_that_are_not_clean_too_long_or_too_many_are_damaged() {
        let of = |names: &[&str]| written(&PlayerNames(names.iter().map(|name| (*name).to_owned()).collect()));
        for names in [&["a\u{1b}[2J"][..], &[&"x".repeat(41)], &["a"; 9]] {
            let error = PlayerNames::read(&mut Reader::new(&of(names), "its content"));
            assert_eq!(error, Err(RecordError::Damaged("its names")));
        }
    }
}
