//! AVX2 registers (256 bits).
//!
//! Used only where the processor is known to have AVX2, which [`crate::kernel::inner_loop`] checks.

use std::arch::x86_64::*;

use super::lanes::Transpose;
use super::register::{SplitRow, collect, register, transpose_fours};

register! {
    /// Register of eight f32.
    F32: 8 x f32 => __m256, mask __m256;
    _mm256_set1_ps; _mm256_loadu_ps; _mm256_storeu_ps; _mm256_sqrt_ps;
    _mm256_add_ps; _mm256_sub_ps; _mm256_mul_ps; _mm256_div_ps; |x| _mm256_xor_ps(x, _mm256_set1_ps(-0.0)); _mm256_min_ps;
    _mm256_cmp_ps::<_CMP_LT_OQ>; |m, yes, no| _mm256_blendv_ps(no, yes, m); _mm256_and_ps; |m| _mm256_movemask_ps(m) != 0
}
register! {
    /// Register of four f64.
    F64: 4 x f64 => __m256d, mask __m256d;
    _mm256_set1_pd; _mm256_loadu_pd; _mm256_storeu_pd; _mm256_sqrt_pd;
    _mm256_add_pd; _mm256_sub_pd; _mm256_mul_pd; _mm256_div_pd; |x| _mm256_xor_pd(x, _mm256_set1_pd(-0.0)); _mm256_min_pd;
    _mm256_cmp_pd::<_CMP_LT_OQ>; |m, yes, no| _mm256_blendv_pd(no, yes, m); _mm256_and_pd; |m| _mm256_movemask_pd(m) != 0
}

impl Transpose for F32 {
    type Scalar = f32;
    type Row = SplitRow<Self, 1>;
    type Rows = [Self::Row; 8];
    #[inline(always)]
    fn columns(row: impl FnMut(usize) -> Self::Row) -> [Self; 8] {
        let [a, b, c, d, e, f, g, h]: [Self::Row; 8] = collect(row);
        let [a, b, c, d, e, f, g, h] =
            transpose8([a.0[0].0, b.0[0].0, c.0[0].0, d.0[0].0, e.0[0].0, f.0[0].0, g.0[0].0, h.0[0].0]);
        [Self(a), Self(b), Self(c), Self(d), Self(e), Self(f), Self(g), Self(h)]
    }
    #[inline(always)]
    fn rows([a, b, c, d, e, f, g, h]: [Self; 8]) -> Self::Rows {
        let [a, b, c, d, e, f, g, h] = transpose8([a.0, b.0, c.0, d.0, e.0, f.0, g.0, h.0]);
        [row(a), row(b), row(c), row(d), row(e), row(f), row(g), row(h)]
    }
}
transpose_fours!(F64, f64, transpose4);

/// Row in one register.
#[inline(always)]
pub fn row(x: __m256) -> SplitRow<F32, 1> {
    SplitRow([F32(x)])
}

/// Transposes eight registers: pairs of rows, then fours, then the halves.
#[inline(always)]
fn transpose8([a, b, c, d, e, f, g, h]: [__m256; 8]) -> [__m256; 8] {
    // SAFETY: see the module documentation.
    unsafe {
        let (ab0, ab1) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        let (cd0, cd1) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        let (ef0, ef1) = (_mm256_unpacklo_ps(e, f), _mm256_unpackhi_ps(e, f));
        let (gh0, gh1) = (_mm256_unpacklo_ps(g, h), _mm256_unpackhi_ps(g, h));
        let (u0, u1) = (_mm256_shuffle_ps::<0x44>(ab0, cd0), _mm256_shuffle_ps::<0xee>(ab0, cd0));
        let (u2, u3) = (_mm256_shuffle_ps::<0x44>(ab1, cd1), _mm256_shuffle_ps::<0xee>(ab1, cd1));
        let (l0, l1) = (_mm256_shuffle_ps::<0x44>(ef0, gh0), _mm256_shuffle_ps::<0xee>(ef0, gh0));
        let (l2, l3) = (_mm256_shuffle_ps::<0x44>(ef1, gh1), _mm256_shuffle_ps::<0xee>(ef1, gh1));
        [
            _mm256_permute2f128_ps::<0x20>(u0, l0),
            _mm256_permute2f128_ps::<0x20>(u1, l1),
            _mm256_permute2f128_ps::<0x20>(u2, l2),
            _mm256_permute2f128_ps::<0x20>(u3, l3),
            _mm256_permute2f128_ps::<0x31>(u0, l0),
            _mm256_permute2f128_ps::<0x31>(u1, l1),
            _mm256_permute2f128_ps::<0x31>(u2, l2),
            _mm256_permute2f128_ps::<0x31>(u3, l3),
        ]
    }
}

#[inline(always)]
fn transpose4([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    // SAFETY: see the module documentation.
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
