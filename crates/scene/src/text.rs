//! Text of files in any of the common encodings.

use std::io::{self, BufRead, BufReader, Read};

use flate2::bufread::MultiGzDecoder;

use crate::error::SceneError;

/// Bytes read at a time.
const CHUNK: usize = 1 << 16;

/// Reads text and stops after `limit` bytes of it.
///
/// The text may be UTF-8 or UTF-16 of either byte order, with or without a byte order mark, and
/// compressed by gzip. A mark is left out. The limit holds for the text, however small it is when
/// compressed, and not much more than it is allocated.
///
/// # Errors
/// When the reader fails, the text has more than `limit` bytes, or the bytes are not text.
///
/// ```
/// let utf16: Vec<u8> = "\u{feff}{}".encode_utf16().flat_map(u16::to_le_bytes).collect();
/// assert_eq!(teeter_scene::read_text(&utf16[..], 100)?, "{}");
/// # Ok::<(), teeter_scene::SceneError>(())
/// ```
pub fn read_text(reader: impl Read, limit: u64) -> Result<String, SceneError> {
    let mut text = utf8(reader).map_err(read_error)?;
    let mut bytes = Vec::new();
    let mut chunk = vec![0; CHUNK];
    loop {
        let count = text.read(&mut chunk).map_err(read_error)?;
        if count == 0 {
            break;
        }
        let length = bytes.len() + count;
        if length as u64 > limit {
            return Err(SceneError::TooLarge { limit_mb: limit / 1_000_000 });
        }
        if length > bytes.capacity() {
            // Grows by a half, not beyond the limit.
            let capacity = (length + length / 2).min(usize::try_from(limit).unwrap_or(usize::MAX));
            bytes.reserve_exact(capacity.max(length) - bytes.len());
        }
        bytes.extend_from_slice(&chunk[..count]);
    }
    String::from_utf8(bytes).map_err(|e| SceneError::NotUtf8(e.utf8_error().valid_up_to()))
}

fn read_error(error: io::Error) -> SceneError {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => SceneError::Read("its end is missing".into()),
        _ => SceneError::Read(error.to_string()),
    }
}

/// Returns a reader of text as UTF-8 without a byte order mark, from UTF-8 or UTF-16 of either byte
/// order, compressed by gzip or not. Bytes that are neither are passed on as they are.
///
/// # Errors
/// When the reader fails.
///
/// ```
/// use std::io::Read;
///
/// let mut text = String::new();
/// teeter_scene::utf8(&b"\xef\xbb\xbf{}"[..])?.read_to_string(&mut text)?;
/// assert_eq!(text, "{}");
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn utf8<'a>(reader: impl Read + 'a) -> io::Result<Box<dyn Read + 'a>> {
    let mut plain = Prefetched::new(Box::new(reader))?;
    if plain.start().starts_with(&[0x1f, 0x8b]) {
        plain = Prefetched::new(Box::new(MultiGzDecoder::new(BufReader::new(plain))))?;
    }
    // A text that begins with an ASCII character has a zero byte beside it in UTF-16.
    let (mark, encoding) = match *plain.start() {
        [0xef, 0xbb, 0xbf, ..] => (3, None),
        [0xff, 0xfe, ..] => (2, Some(u16::from_le_bytes as Unit)),
        [0xfe, 0xff, ..] => (2, Some(u16::from_be_bytes as Unit)),
        [first, 0, ..] if first != 0 => (0, Some(u16::from_le_bytes as Unit)),
        [0, second, ..] if second != 0 => (0, Some(u16::from_be_bytes as Unit)),
        _ => (0, None),
    };
    plain.sent = mark;
    Ok(match encoding {
        Some(unit) => Box::new(Utf16 { reader: BufReader::new(plain), unit, high: None, pending: Vec::new(), sent: 0 }),
        None => Box::new(plain),
    })
}

/// Code unit of UTF-16 from two bytes.
type Unit = fn([u8; 2]) -> u16;

/// Reader whose first bytes are known.
struct Prefetched<'a> {
    reader: Box<dyn Read + 'a>,
    start: [u8; 3],
    /// Number of bytes in `start`.
    length: usize,
    /// Number of bytes of `start` that are read.
    sent: usize,
}

impl<'a> Prefetched<'a> {
    fn new(mut reader: Box<dyn Read + 'a>) -> io::Result<Self> {
        let mut start = [0; 3];
        let mut length = 0;
        while length < start.len() {
            match reader.read(&mut start[length..]) {
                Ok(0) => break,
                Ok(count) => length += count,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(Self { reader, start, length, sent: 0 })
    }

    fn start(&self) -> &[u8] {
        &self.start[..self.length]
    }
}

impl Read for Prefetched<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.sent == self.length {
            return self.reader.read(buffer);
        }
        let count = buffer.len().min(self.length - self.sent);
        buffer[..count].copy_from_slice(&self.start[self.sent..self.sent + count]);
        self.sent += count;
        Ok(count)
    }
}

/// Reader that turns UTF-16 into UTF-8.
struct Utf16<R> {
    reader: R,
    unit: Unit,
    /// First half of a surrogate pair.
    high: Option<u16>,
    /// UTF-8 that is not yet read, from `sent`.
    pending: Vec<u8>,
    sent: usize,
}

impl<R: BufRead> Utf16<R> {
    /// Decodes what the inner reader has ready.
    fn fill(&mut self) -> io::Result<()> {
        self.pending.clear();
        self.sent = 0;
        let mut units = Vec::from_iter(self.high.take());
        while units.len() < CHUNK {
            let mut bytes = [0; 2];
            match self.reader.fill_buf()?.len() {
                0 => break,
                _ => self.reader.read_exact(&mut bytes)?,
            }
            units.push((self.unit)(bytes));
        }
        if units.len() >= CHUNK && units.last().is_some_and(|unit| (0xd800..0xdc00).contains(unit)) {
            self.high = units.pop();
        }
        for c in char::decode_utf16(units) {
            let c = c.map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is no valid UTF-16"))?;
            self.pending.extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes());
        }
        Ok(())
    }
}

impl<R: BufRead> Read for Utf16<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.sent == self.pending.len() {
            self.fill()?;
        }
        let count = buffer.len().min(self.pending.len() - self.sent);
        buffer[..count].copy_from_slice(&self.pending[self.sent..self.sent + count]);
        self.sent += count;
        Ok(count)
    }
}
