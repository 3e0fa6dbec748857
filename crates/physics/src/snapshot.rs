//! The whole state as bytes, and its hash.

use crate::world::{State, World};

/// Why bytes are no snapshot of this world.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("not a snapshot of this world: {0}")]
pub struct SnapshotError(String);

/// First bytes of a snapshot: what it is, and the version of its layout.
const MAGIC: &[u8] = b"teeter\x00\x01";

impl World {
    /// The whole state as bytes. They hold neither the scene nor the constants.
    pub fn snapshot(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(postcard::to_stdvec(&self.state).expect("plain numbers can always be written"));
        bytes
    }

    /// Takes back a state of a world of the same scene and constants; it goes on bit for bit as that one did.
    ///
    /// # Errors
    /// When the bytes are no snapshot or one of another number of bodies; the world is then unchanged.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        let body = bytes.strip_prefix(MAGIC).ok_or_else(|| SnapshotError("it does not begin like one".into()))?;
        let state: State = postcard::from_bytes(body).map_err(|e| SnapshotError(e.to_string()))?;
        if state.bodies.len() != self.len() {
            return Err(SnapshotError(format!("it has {} bodies instead of {}", state.bodies.len(), self.len())));
        }
        self.state = state;
        self.write_poses();
        Ok(())
    }

    /// Hash of the whole state (XXH3, 64 bits): equal states have equal hashes on every target.
    pub fn hash(&self) -> u64 {
        xxhash_rust::xxh3::xxh3_64(&self.snapshot())
    }
}
