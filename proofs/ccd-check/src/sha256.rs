//! The hash function SHA-256 `[FIPS180-4]`.

use alloc::vec::Vec;

/// Returns the SHA-256 digest of bytes.
pub fn sha256(bytes: &[u8]) -> [u8; 32] {
    // The initial state: the first 32 bits of the fractional parts of the square roots of the first 8 primes. The constants `k`: the
    // first 32 bits of the fractional parts of the cube roots of the first 64 primes.
    let mut state = [2u128, 3, 5, 7, 11, 13, 17, 19].map(|prime| (prime << 64).isqrt() as u32);
    let primes = (2u128..).filter(|n| (2..*n).all(|divisor| n % divisor > 0));
    let bits = || (0..35).rev().map(|bit| 1u128 << bit);
    let cube_root = |x: u128| bits().fold(0, |root, bit| if (root + bit).pow(3) <= x { root + bit } else { root });
    let k: Vec<u32> = primes.take(64).map(|prime| cube_root(prime << 96) as u32).collect();
    let sum = |words: &[u32]| words.iter().fold(0, |sum: u32, &word| sum.wrapping_add(word));
    // The padding is a 1 bit, zeros, and the length in bits.
    let mut padded = [bytes, &[0x80]].concat();
    padded.resize((bytes.len() + 72) / 64 * 64 - 8, 0);
    padded.extend((8 * bytes.len() as u64).to_be_bytes());
    for block in padded.chunks(64) {
        let mut w: Vec<u32> = block.as_chunks().0.iter().map(|&bytes| u32::from_be_bytes(bytes)).collect();
        let old_state = state;
        for t in 0..64 {
            let (x, y, [a, b, c, _, e, f, g, h]) = (w[t + 1], w[t + 14], state);
            let s0 = x.rotate_right(7) ^ x.rotate_right(18) ^ (x >> 3);
            let s1 = y.rotate_right(17) ^ y.rotate_right(19) ^ (y >> 10);
            w.push(sum(&[w[t], s0, w[t + 9], s1]));
            let s0 = a.rotate_right(2) ^ a.rotate_right(13) ^ a.rotate_right(22);
            let s1 = e.rotate_right(6) ^ e.rotate_right(11) ^ e.rotate_right(25);
            let t1 = sum(&[h, s1, (e & f) ^ (!e & g), k[t], w[t]]);
            state.rotate_right(1);
            state[0] = sum(&[t1, s0, (a & b) ^ (a & c) ^ (b & c)]);
            state[4] = sum(&[state[4], t1]);
        }
        state.iter_mut().zip(old_state).for_each(|(word, old_word)| *word = word.wrapping_add(old_word));
    }
    core::array::from_fn(|k| state[k / 4].to_be_bytes()[k % 4])
}

#[cfg(test)]
mod tests {
    use super::sha256;

    fn hexadecimal(bytes: &[u8]) -> alloc::string::String {
        let digits = sha256(bytes).map(|byte| alloc::format!("{byte:02x}"));
        digits.concat()
    }

    /// Tests the examples of the standard.
    #[test]
    fn digests_are_those_of_the_standard() {
        let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(hexadecimal(b""), empty);
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(hexadecimal(b"abc"), abc);
        let two_blocks = b"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
        let expected = "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1";
        assert_eq!(hexadecimal(two_blocks), expected);
        let million = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
        assert_eq!(hexadecimal(&alloc::vec![b'a'; 1_000_000]), million);
    }
}
