//! Lanes in AVX2 registers: one for f32, two for f64.
//!
//! These types may only be used where AVX2 is known to be there; [`crate::kernel`] is the one place that does.

use std::arch::x86_64::*;

use super::{LANES, Lanes, in_quarters, operators};

/// Eight f32 in one register.
#[derive(Debug, Clone, Copy)]
pub struct F32([__m256; 1]);
/// Eight f64 in two.
#[derive(Debug, Clone, Copy)]
pub struct F64([__m256d; 2]);

// SAFETY, here and below: callers have checked for AVX2; loads and stores go through references to eight numbers.
operators!(
    F32,
    |a, b| unsafe { _mm256_add_ps(a, b) },
    unsafe { _mm256_sub_ps(a, b) },
    unsafe { _mm256_mul_ps(a, b) },
    unsafe { _mm256_div_ps(a, b) },
    |c| unsafe { _mm256_xor_ps(c, _mm256_set1_ps(-0.0)) }
);
operators!(
    F64,
    |a, b| unsafe { _mm256_add_pd(a, b) },
    unsafe { _mm256_sub_pd(a, b) },
    unsafe { _mm256_mul_pd(a, b) },
    unsafe { _mm256_div_pd(a, b) },
    |c| unsafe { _mm256_xor_pd(c, _mm256_set1_pd(-0.0)) }
);

impl Lanes for F32 {
    type Number = f32;
    type Mask = __m256;
    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self([unsafe { _mm256_set1_ps(x) }])
    }
    #[inline(always)]
    fn load(from: &[f32; LANES]) -> Self {
        Self([unsafe { _mm256_loadu_ps(from.as_ptr()) }])
    }
    #[inline(always)]
    fn store(self, to: &mut [f32; LANES]) {
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0[0]) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self([unsafe { _mm256_sqrt_ps(self.0[0]) }])
    }
    #[inline(always)]
    fn less(self, other: Self) -> __m256 {
        unsafe { _mm256_cmp_ps::<_CMP_LT_OQ>(self.0[0], other.0[0]) }
    }
    #[inline(always)]
    fn select(mask: __m256, yes: Self, no: Self) -> Self {
        Self([unsafe { _mm256_blendv_ps(no.0[0], yes.0[0], mask) }])
    }
    #[inline(always)]
    fn any(mask: __m256) -> bool {
        unsafe { _mm256_movemask_ps(mask) != 0 }
    }
    #[inline(always)]
    fn both(a: __m256, b: __m256) -> __m256 {
        unsafe { _mm256_and_ps(a, b) }
    }
    #[inline(always)]
    fn transpose(rows: [Self; 8]) -> [Self; 8] {
        unsafe {
            let [a, b, c, d, e, f, g, h] = rows.map(|r| r.0[0]);
            // pairs of rows, then fours, then the halves
            let (ab0, ab1) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
            let (cd0, cd1) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
            let (ef0, ef1) = (_mm256_unpacklo_ps(e, f), _mm256_unpackhi_ps(e, f));
            let (gh0, gh1) = (_mm256_unpacklo_ps(g, h), _mm256_unpackhi_ps(g, h));
            let (u0, u1) = (_mm256_shuffle_ps::<0x44>(ab0, cd0), _mm256_shuffle_ps::<0xee>(ab0, cd0));
            let (u2, u3) = (_mm256_shuffle_ps::<0x44>(ab1, cd1), _mm256_shuffle_ps::<0xee>(ab1, cd1));
            let (l0, l1) = (_mm256_shuffle_ps::<0x44>(ef0, gh0), _mm256_shuffle_ps::<0xee>(ef0, gh0));
            let (l2, l3) = (_mm256_shuffle_ps::<0x44>(ef1, gh1), _mm256_shuffle_ps::<0xee>(ef1, gh1));
            [
                Self([_mm256_permute2f128_ps::<0x20>(u0, l0)]),
                Self([_mm256_permute2f128_ps::<0x20>(u1, l1)]),
                Self([_mm256_permute2f128_ps::<0x20>(u2, l2)]),
                Self([_mm256_permute2f128_ps::<0x20>(u3, l3)]),
                Self([_mm256_permute2f128_ps::<0x31>(u0, l0)]),
                Self([_mm256_permute2f128_ps::<0x31>(u1, l1)]),
                Self([_mm256_permute2f128_ps::<0x31>(u2, l2)]),
                Self([_mm256_permute2f128_ps::<0x31>(u3, l3)]),
            ]
        }
    }
}

impl Lanes for F64 {
    type Number = f64;
    type Mask = [__m256d; 2];
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([unsafe { _mm256_set1_pd(x) }; 2])
    }
    #[inline(always)]
    fn load(from: &[f64; LANES]) -> Self {
        unsafe { Self([_mm256_loadu_pd(from.as_ptr()), _mm256_loadu_pd(from.as_ptr().add(4))]) }
    }
    #[inline(always)]
    fn store(self, to: &mut [f64; LANES]) {
        unsafe {
            _mm256_storeu_pd(to.as_mut_ptr(), self.0[0]);
            _mm256_storeu_pd(to.as_mut_ptr().add(4), self.0[1]);
        }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(|x| unsafe { _mm256_sqrt_pd(x) }))
    }
    #[inline(always)]
    fn less(self, other: Self) -> [__m256d; 2] {
        std::array::from_fn(|i| unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0[i], other.0[i]) })
    }
    #[inline(always)]
    fn select(mask: [__m256d; 2], yes: Self, no: Self) -> Self {
        Self(std::array::from_fn(|i| unsafe { _mm256_blendv_pd(no.0[i], yes.0[i], mask[i]) }))
    }
    #[inline(always)]
    fn any(mask: [__m256d; 2]) -> bool {
        unsafe { _mm256_movemask_pd(_mm256_or_pd(mask[0], mask[1])) != 0 }
    }
    #[inline(always)]
    fn both(a: [__m256d; 2], b: [__m256d; 2]) -> [__m256d; 2] {
        std::array::from_fn(|i| unsafe { _mm256_and_pd(a[i], b[i]) })
    }
    #[inline(always)]
    fn transpose(rows: [Self; 8]) -> [Self; 8] {
        in_quarters(rows.map(|r| r.0), quarter).map(Self)
    }
}

#[inline(always)]
fn quarter([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    unsafe {
        let (ab0, ab1) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (cd0, cd1) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(ab0, cd0),
            _mm256_permute2f128_pd::<0x20>(ab1, cd1),
            _mm256_permute2f128_pd::<0x31>(ab0, cd0),
            _mm256_permute2f128_pd::<0x31>(ab1, cd1),
        ]
    }
}
