//! How the processor rounds, whatever the host has set.

/// While this lives, results are rounded to nearest and subnormal numbers are kept, as the language and every other target have it.
/// A host may have set its thread otherwise: audio programs flush subnormals to zero, some libraries set it on loading.
#[derive(Debug)]
pub struct FloatMode {
    #[cfg(target_arch = "x86_64")]
    found: u32,
}

impl FloatMode {
    /// The standard mode from here on; dropping this gives the host its own back.
    #[cfg(target_arch = "x86_64")]
    pub fn standard() -> Self {
        let found = x86_64::control();
        if found & x86_64::MODE != x86_64::STANDARD {
            x86_64::set_control(found & !x86_64::MODE | x86_64::STANDARD);
        }
        Self { found }
    }

    /// The standard mode from here on: other processors come with it set, and WebAssembly has no other.
    #[cfg(not(target_arch = "x86_64"))]
    pub fn standard() -> Self {
        Self {}
    }
}

#[cfg(target_arch = "x86_64")]
impl Drop for FloatMode {
    fn drop(&mut self) {
        if self.found & x86_64::MODE != x86_64::STANDARD {
            x86_64::set_control(self.found);
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod x86_64 {
    use std::arch::asm;

    /// Subnormal operands as zero, all exceptions masked, rounding, subnormal results to zero: all that is not a record of the past.
    pub const MODE: u32 = 1 << 6 | 0x3f << 7 | 3 << 13 | 1 << 15;
    /// Exceptions masked, the rest zero.
    pub const STANDARD: u32 = 0x3f << 7;

    /// The control and status register of SSE.
    pub fn control() -> u32 {
        let mut value = 0_u32;
        // SAFETY: writes four bytes to where it is told.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut value, options(nostack, preserves_flags)) };
        value
    }

    /// Sets it. Bits above the sixteenth must be zero.
    pub fn set_control(value: u32) {
        // SAFETY: reads four bytes; the only values given are the standard one and one that the processor held before.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const value, options(nostack, preserves_flags)) };
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use std::hint::black_box;

    use super::{FloatMode, x86_64};

    #[test]
    fn a_host_that_flushes_and_truncates_gets_its_mode_back() {
        let before = x86_64::control();
        let host = x86_64::STANDARD | 1 << 6 | 3 << 13 | 1 << 15;
        let sum = || black_box(1.0_f32) + black_box(0.9e-7_f32);
        let half = || black_box(f32::MIN_POSITIVE) * black_box(0.5);
        x86_64::set_control(host);
        let (up, small) = (sum(), half());
        let inside = {
            let _mode = FloatMode::standard();
            (sum(), half())
        };
        let after = (x86_64::control() & x86_64::MODE, sum(), half());
        x86_64::set_control(before);
        assert_eq!((up, small), (1.0, 0.0), "the host's mode had no effect");
        assert_eq!(inside, (1.0 + f32::EPSILON, f32::MIN_POSITIVE / 2.0));
        assert_eq!(after, (host, 1.0, 0.0));
    }
}
