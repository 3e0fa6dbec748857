//! Envelope of a snapshot: kind and version, exact length and checksum, then the content.
//!
//! For the crates of Teeter that have snapshots of their own; not a part of the interface.

/// Bytes of length and checksum.
const LEN: usize = 16;

/// Reason why bytes are no envelope of a kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EnvelopeError {
    /// The bytes do not begin with the kind.
    Kind,
    /// Length or checksum differ.
    Damaged,
}

/// Puts content into an envelope. `kind` names content and version, and begins the bytes.
pub fn seal(kind: &[u8], content: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(kind.len() + LEN + content.len());
    bytes.extend(kind);
    bytes.extend((content.len() as u64).to_le_bytes());
    bytes.extend(checksum(content).to_le_bytes());
    bytes.extend(content);
    bytes
}

/// Returns the content of an envelope of this kind.
///
/// # Errors
/// When the bytes are of another kind or version, or anything in them has changed.
pub fn open<'a>(kind: &[u8], bytes: &'a [u8]) -> Result<&'a [u8], EnvelopeError> {
    let rest = bytes.strip_prefix(kind).ok_or(EnvelopeError::Kind)?;
    let (len, rest) = rest.split_first_chunk().ok_or(EnvelopeError::Damaged)?;
    let (sum, content) = rest.split_first_chunk().ok_or(EnvelopeError::Damaged)?;
    let intact = u64::from_le_bytes(*len) == content.len() as u64 && u64::from_le_bytes(*sum) == checksum(content);
    if intact { Ok(content) } else { Err(EnvelopeError::Damaged) }
}

/// Checksum of the content (XXH3, 64 bits).
pub fn checksum(content: &[u8]) -> u64 {
    xxhash_rust::xxh3::xxh3_64(content)
}
