//! AVX-512 registers (512 bits) of f32.
//!
//! Used only where [`available`] returns true, which [`crate::kernel::inner_loop`] checks.

use std::arch::x86_64::*;

use super::avx2;
use super::lanes::Transpose;
use super::register::{SplitRow, collect, register};

/// Returns true if the processor has all extensions that are used here.
pub fn available() -> bool {
    std::is_x86_feature_detected!("avx512f")
        && std::is_x86_feature_detected!("avx512vl")
        && std::is_x86_feature_detected!("avx512dq")
        && std::is_x86_feature_detected!("avx512bw")
}

register! {
    /// Register of sixteen f32.
    F32: 16 x f32 => __m512, mask __mmask16;
    _mm512_set1_ps; _mm512_loadu_ps; _mm512_storeu_ps; _mm512_sqrt_ps;
    _mm512_add_ps; _mm512_sub_ps; _mm512_mul_ps; _mm512_div_ps; |x| _mm512_xor_ps(x, _mm512_set1_ps(-0.0)); _mm512_min_ps;
    _mm512_cmp_ps_mask::<_CMP_LT_OQ>; |m, yes, no| _mm512_mask_blend_ps(m, no, yes); _mm512_maskz_mov_ps; |m| m != 0
}

// SAFETY, of all blocks below: see the module documentation.
impl Transpose for F32 {
    type Scalar = f32;
    type Row = SplitRow<avx2::F32, 1>;
    type Rows = [Self::Row; 16];
    #[inline(always)]
    fn columns(row: impl FnMut(usize) -> Self::Row) -> [Self; 8] {
        let r: [Self::Row; 16] = collect(row);
        unsafe {
            // Rows l and l + 4 share a register, so that columns come out in the order of the rows.
            let [a, b, c, d] = transpose4([pair(r[0], r[4]), pair(r[1], r[5]), pair(r[2], r[6]), pair(r[3], r[7])]);
            let [e, f, g, h] =
                transpose4([pair(r[8], r[12]), pair(r[9], r[13]), pair(r[10], r[14]), pair(r[11], r[15])]);
            [
                Self(_mm512_shuffle_f32x4::<0x88>(a, e)),
                Self(_mm512_shuffle_f32x4::<0x88>(b, f)),
                Self(_mm512_shuffle_f32x4::<0x88>(c, g)),
                Self(_mm512_shuffle_f32x4::<0x88>(d, h)),
                Self(_mm512_shuffle_f32x4::<0xdd>(a, e)),
                Self(_mm512_shuffle_f32x4::<0xdd>(b, f)),
                Self(_mm512_shuffle_f32x4::<0xdd>(c, g)),
                Self(_mm512_shuffle_f32x4::<0xdd>(d, h)),
            ]
        }
    }
    #[inline(always)]
    fn rows([a, b, c, d, e, f, g, h]: [Self; 8]) -> Self::Rows {
        unsafe {
            let first = _mm512_setr_epi32(0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23);
            let second = _mm512_setr_epi32(8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15, 28, 29, 30, 31);
            let [p, q, r, s] = transpose4([join(a, first, e), join(b, first, f), join(c, first, g), join(d, first, h)]);
            let [t, u, v, w] =
                transpose4([join(a, second, e), join(b, second, f), join(c, second, g), join(d, second, h)]);
            [
                low(p),
                low(q),
                low(r),
                low(s),
                high(p),
                high(q),
                high(r),
                high(s),
                low(t),
                low(u),
                low(v),
                low(w),
                high(t),
                high(u),
                high(v),
                high(w),
            ]
        }
    }
}

#[inline(always)]
fn pair(a: SplitRow<avx2::F32, 1>, b: SplitRow<avx2::F32, 1>) -> __m512 {
    unsafe { _mm512_insertf32x8::<1>(_mm512_castps256_ps512(a.0[0].0), b.0[0].0) }
}

#[inline(always)]
fn join(a: F32, index: __m512i, b: F32) -> __m512 {
    unsafe { _mm512_permutex2var_ps(a.0, index, b.0) }
}

#[inline(always)]
fn low(x: __m512) -> SplitRow<avx2::F32, 1> {
    avx2::row(unsafe { _mm512_castps512_ps256(x) })
}

#[inline(always)]
fn high(x: __m512) -> SplitRow<avx2::F32, 1> {
    avx2::row(unsafe { _mm512_extractf32x8_ps::<1>(x) })
}

/// Transposes four registers within each 128-bit quarter.
#[inline(always)]
fn transpose4([a, b, c, d]: [__m512; 4]) -> [__m512; 4] {
    unsafe {
        let (ab0, ab1) = (_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
        let (cd0, cd1) = (_mm512_unpacklo_ps(c, d), _mm512_unpackhi_ps(c, d));
        [
            _mm512_shuffle_ps::<0x44>(ab0, cd0),
            _mm512_shuffle_ps::<0xee>(ab0, cd0),
            _mm512_shuffle_ps::<0x44>(ab1, cd1),
            _mm512_shuffle_ps::<0xee>(ab1, cd1),
        ]
    }
}
