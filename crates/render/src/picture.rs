//! Pictures: rows of pixels.

use core::fmt;
use core::str::FromStr;

/// Maximum width and height of a picture, px.
pub const MAX_SIDE: u32 = 8192;

/// Width and height of a picture, px, each from 1 to [`MAX_SIDE`].
///
/// ```
/// use teeter_render::Size;
///
/// let size: Size = "1280x720".parse().unwrap();
/// assert_eq!((size.width, size.height), (1280, 720));
/// assert!("0x720".parse::<Size>().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    /// Width, px.
    pub width: u32,
    /// Height, px.
    pub height: u32,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let side = |text: &str| text.parse::<u32>().ok().filter(|side| (1..=MAX_SIDE).contains(side));
        let size = text.split_once(['x', 'X']).and_then(|(width, height)| {
            let (width, height) = (side(width)?, side(height)?);
            Some(Self { width, height })
        });
        size.ok_or_else(|| format!("expected WIDTHxHEIGHT, each from 1 to {MAX_SIDE} pixels"))
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// Picture, as sRGB with eight bits a channel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width and height, px.
    pub size: Size,
    /// Red, green and blue of each pixel, row by row from the top.
    pub rgb: Vec<u8>,
}

impl Picture {
    /// Returns red, green and blue of a pixel.
    ///
    /// # Panics
    /// When the pixel is outside of the picture.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        assert!(x < self.size.width && y < self.size.height, "pixel {x}, {y} is outside of {}", self.size);
        let at = 3 * (y as usize * self.size.width as usize + x as usize);
        [self.rgb[at], self.rgb[at + 1], self.rgb[at + 2]]
    }
}
