#![doc = include_str!("../README.md")]

use std::fmt::Display;

use wasm_bindgen::prelude::*;

/// Error of a WebAssembly module: one line for the user.
///
/// JavaScript receives it as an `Error` with this line as its message, so an exported function may
/// return `Result<T, Error>`.
///
/// ```
/// use teeter_wasm_support::Error;
///
/// fn half(text: &str) -> Result<u32, Error> {
///     let number: u32 = text.parse().map_err(|error| Error::json("number", error))?;
///     if number % 2 == 0 { Ok(number / 2) } else { Err(Error::rejected("the number is odd")) }
/// }
/// assert_eq!(half("6"), Ok(3));
/// assert_eq!(half("7").unwrap_err().to_string(), "the number is odd");
/// assert_eq!(half("x").unwrap_err().to_string(), "number: invalid digit found in string");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// JSON that cannot be read or written.
    #[error("{subject}: {message}")]
    Json {
        /// Name of the value, such as `input`.
        subject: &'static str,
        /// Message of the parser.
        message: String,
    },
    /// Valid input that the simulator does not accept.
    #[error("{0}")]
    Rejected(String),
}

impl Error {
    /// Creates an error for the JSON of the value called `subject`.
    pub fn json(subject: &'static str, error: impl Display) -> Self {
        Self::Json { subject, message: error.to_string() }
    }

    /// Creates an error for input that the simulator does not accept.
    pub fn rejected(error: impl Display) -> Self {
        Self::Rejected(error.to_string())
    }
}

impl From<Error> for JsValue {
    fn from(error: Error) -> Self {
        JsError::new(&error.to_string()).into()
    }
}

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = console, js_name = error)]
    fn console_error(line: &str);
}

/// Installs a panic hook that prints to the console: without it a panic reads "unreachable
/// executed".
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen(start)]
pub fn report_panics() {
    std::panic::set_hook(Box::new(|info| console_error(&info.to_string())));
}
