//! A small fast hash for the tables of nodes, which are never iterated.

use std::hash::{BuildHasherDefault, Hasher};

/// Builds a [`NodeHasher`].
pub type NodeHash = BuildHasherDefault<NodeHasher>;

/// Multiplies and rotates; keys are a few small integers from a file that is checked before, not from an adversary.
#[derive(Default)]
pub struct NodeHasher(u64);

impl Hasher for NodeHasher {
    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 32
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|byte| self.write_u64(u64::from(*byte)));
    }

    fn write_u32(&mut self, value: u32) {
        self.write_u64(u64::from(value));
    }

    fn write_isize(&mut self, value: isize) {
        self.write_u64(value as u64);
    }

    fn write_u64(&mut self, value: u64) {
        self.0 = (self.0.rotate_left(5) ^ value).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
}
