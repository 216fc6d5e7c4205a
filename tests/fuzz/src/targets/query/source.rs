//! Reads numbers from the bytes of a fuzz input.

/// A reader of numbers from bytes. Most numbers take one byte, and numbers often repeat, so that edges align and gaps
/// vanish.
pub(super) struct NumberReader<'a> {
    bytes: &'a [u8],
    numbers_so_far: Vec<f64>,
}

/// The tag byte before a number in eight bytes.
pub(super) const RAW_NUMBER_TAG: u8 = 255;
/// The number of tag bytes that stand for multiples of 1/16, from −4 to below 4.
pub(super) const FIXED_POINT_TAG_COUNT: u8 = 128;

impl<'a> NumberReader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        NumberReader {
            bytes,
            numbers_so_far: Vec::new(),
        }
    }

    /// Reads a byte; 0 after the end of the input.
    pub(super) fn read_byte(&mut self) -> u8 {
        let [byte] = self.read_bytes();
        byte
    }

    fn read_bytes<const N: usize>(&mut self) -> [u8; N] {
        let mut out = [0; N];
        let there = self.bytes.len().min(N);
        let (taken, rest) = self.bytes.split_at(there);
        out[..there].copy_from_slice(taken);
        self.bytes = rest;
        out
    }

    pub(super) fn read_count(&mut self, from: u8, below: u8) -> u8 {
        from + self.read_byte() % (below - from)
    }

    pub(super) fn read_number(&mut self) -> f64 {
        let tag = if self.bytes.is_empty() {
            64
        } else {
            self.read_byte()
        };
        let x = match tag {
            0..FIXED_POINT_TAG_COUNT => (f64::from(tag) - 64.0) / 16.0,
            FIXED_POINT_TAG_COUNT..192 => self.earlier_number(tag - FIXED_POINT_TAG_COUNT),
            192..208 => {
                let power = 2f64.powi(i32::from(self.read_byte().cast_signed()));
                if tag % 2 == 0 { power } else { -power }
            }
            208..224 => {
                let ulps = i64::from(self.read_byte().cast_signed());
                let bits = self.earlier_number(tag - 208).to_bits();
                f64::from_bits(bits.wrapping_add_signed(ulps))
            }
            224..240 => f64::from(i32::from_le_bytes(self.read_bytes())) / f64::from(1 << 31),
            240..248 => {
                let power = 10f64.powf(0.25 * f64::from(self.read_byte().cast_signed()));
                if tag % 2 == 0 { power } else { -power }
            }
            248..=RAW_NUMBER_TAG => f64::from_le_bytes(self.read_bytes()),
        };
        self.numbers_so_far.push(x);
        x
    }

    /// Returns the number that was read `back` numbers before the last one; 0 if there is none.
    fn earlier_number(&self, back: u8) -> f64 {
        let at = self.numbers_so_far.len().checked_sub(1 + usize::from(back));
        at.map_or(0.0, |at| self.numbers_so_far[at])
    }

    pub(super) fn read_numbers<const N: usize>(&mut self) -> [f64; N] {
        [(); N].map(|()| self.read_number())
    }

    /// Reads `N` numbers if `bit` is true; otherwise returns `or`.
    pub(super) fn read_numbers_if<const N: usize>(&mut self, bit: bool, or: [f64; N]) -> [f64; N] {
        if bit { self.read_numbers() } else { or }
    }
}
