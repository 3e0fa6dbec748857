//! Guard that sets the floating-point mode of the thread, whatever the host has set.

/// Guard under which results are rounded to nearest and subnormal numbers are kept.
///
/// A host may have set its thread otherwise: audio programs flush subnormals to zero, some
/// libraries do so when they are loaded.
#[derive(Debug)]
pub struct FloatMode {
    #[cfg(target_arch = "x86_64")]
    saved: u32,
}

impl FloatMode {
    /// Sets the standard mode; dropping the guard restores that of the host.
    #[cfg(target_arch = "x86_64")]
    pub fn standard() -> Self {
        let saved = x86_64::control();
        if saved & x86_64::MODE != x86_64::STANDARD {
            x86_64::set_control(saved & !x86_64::MODE | x86_64::STANDARD);
        }
        Self { saved }
    }

    /// Does nothing: other processors start in the standard mode, and WebAssembly has no other.
    #[cfg(not(target_arch = "x86_64"))]
    pub fn standard() -> Self {
        Self {}
    }
}

#[cfg(target_arch = "x86_64")]
impl Drop for FloatMode {
    fn drop(&mut self) {
        if self.saved & x86_64::MODE != x86_64::STANDARD {
            x86_64::set_control(self.saved);
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod x86_64 {
    use std::arch::asm;

    /// Control bits: subnormal operands as zero, exception masks, rounding, subnormal results to
    /// zero. The remaining bits are status flags.
    pub const MODE: u32 = 1 << 6 | 0x3f << 7 | 3 << 13 | 1 << 15;
    /// Exceptions masked, all other control bits zero.
    pub const STANDARD: u32 = 0x3f << 7;

    /// Reads the control and status register of SSE.
    pub fn control() -> u32 {
        let mut value = 0_u32;
        // SAFETY: writes four bytes to `value`.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut value, options(nostack, preserves_flags)) };
        value
    }

    /// Writes the control and status register of SSE. Bits above the sixteenth must be zero.
    pub fn set_control(value: u32) {
        // SAFETY: reads four bytes; callers pass the standard mode or one read from the processor.
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
