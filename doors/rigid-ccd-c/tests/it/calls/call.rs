//! A call with random arguments. Each function of `impl Call` draws one argument, and notes it.

use super::places::Place;
use super::world::{Kinds, Pooled, World, pick};
use crate::support::Random;
use rigid_ccd_c::*;
use std::any::Any;
use std::collections::VecDeque;
use std::ffi::{CString, c_char};
use std::fmt::{Debug, Write};
use std::ptr::{null, null_mut};

/// Numbers at the ends of ranges, and NaN.
const ODD_NUMBERS: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    5e-324,
    1e-310,
    -1e-300,
    1e-100,
    f64::EPSILON,
    1e12,
    1e16,
    1e154,
    1e300,
    f64::MAX,
];

pub(super) struct Call<'w, 'f> {
    pub(super) world: &'w mut World<'f>,
    pub(super) random: Random,
    /// Whether some of the arguments are wrong.
    pub(super) is_wrong: bool,
    pub(super) text: String,
    /// The values that pointers point to during the call.
    arena: Vec<Box<dyn Any>>,
    /// The counts that belong to arrays that were drawn, in the order of the arguments.
    pub(super) counts: VecDeque<usize>,
    pub(super) pointers: VecDeque<*const f64>,
    pub(super) places: Vec<Box<dyn Place>>,
    /// The settings that were drawn.
    pub(super) settings: Option<RccdSettings>,
    /// The solver or cell that was drawn.
    pub(super) owner: usize,
    pub(super) joint_count: Option<usize>,
    pub(super) clearance: Option<f64>,
    /// The duration or the number of segments that was drawn.
    pub(super) duration: f64,
    pub(super) segments: usize,
    pub(super) vertex_count: u32,
    /// The solver to use in place of the drawn one.
    pub(super) other_solver: Option<*mut RccdSolver>,
}

impl<'w, 'f> Call<'w, 'f> {
    pub(super) fn new(world: &'w mut World<'f>, mut random: Random, name: &str) -> Self {
        let is_wrong = random.index(10) < 3;
        let mut call = Call {
            world,
            random,
            is_wrong,
            text: String::new(),
            arena: Vec::new(),
            counts: VecDeque::new(),
            pointers: VecDeque::new(),
            places: Vec::new(),
            settings: None,
            owner: 0,
            joint_count: None,
            clearance: None,
            duration: f64::NAN,
            segments: 0,
            vertex_count: 0,
            other_solver: None,
        };
        call.write(format_args!("{name}: "));
        call
    }

    /// Records an argument. With `CCD_TEST_TRACE` prints it at once, for calls that do not return.
    pub(super) fn note(&mut self, name: &str, value: impl Debug) {
        self.write(format_args!("{name} {value:?}, "));
    }

    pub(super) fn end(&mut self) {
        self.write(format_args!("\n"));
    }

    #[expect(clippy::print_stderr, reason = "a trace was asked for")]
    fn write(&mut self, text: std::fmt::Arguments<'_>) {
        let _ = self.text.write_fmt(text);
        if super::is_traced() {
            eprint!("{text}");
        }
    }

    /// Draws whether an argument is wrong.
    pub(super) fn is_odd(&mut self) -> bool {
        self.is_wrong && self.random.index(4) == 0
    }

    /// Returns true once in `count` times.
    pub(super) fn once_in(&mut self, count: u32) -> bool {
        self.random.index(count) == 0
    }

    /// Keeps a value during the call, and returns a pointer to it, which is sometimes null or misaligned.
    pub(super) fn lend<T: 'static>(&mut self, value: T) -> *const T {
        let pointer = self.keep(vec![value]);
        self.spoil(pointer)
    }

    /// Keeps values during the call.
    pub(super) fn keep<T: 'static>(&mut self, values: Vec<T>) -> *const T {
        let pointer = values.as_ptr();
        self.arena.push(Box::new(values));
        pointer
    }

    /// Returns the pointer, or sometimes an invalid one.
    pub(super) fn spoil<T>(&mut self, pointer: *const T) -> *const T {
        if !self.is_odd() {
            return pointer;
        }
        if align_of::<T>() == 1 || self.once_in(2) {
            self.note("null", ());
            return null();
        }
        self.note("misaligned", ());
        pointer.wrapping_byte_add(1)
    }

    /// Draws one of the values, or any number.
    pub(super) fn number(&mut self, name: &str, usual: f64) -> f64 {
        let odd = self.random.index(ODD_NUMBERS.len() as u32);
        let number = if self.is_odd() {
            ODD_NUMBERS[odd]
        } else {
            usual
        };
        self.note(name, number);
        number
    }

    pub(super) fn length(&mut self) -> f64 {
        // Mostly of the size of the scene.
        let power = if self.once_in(12) { 12.0 } else { 0.7 };
        let usual = 0.6 * 10.0_f64.powf(power * self.random.number());
        self.number("length", usual)
    }

    pub(super) fn distance(&mut self) -> f64 {
        let usual = 0.2 * self.random.number().abs();
        self.number("distance", usual)
    }

    pub(super) fn clearance(&mut self) -> f64 {
        let clearance = self.distance();
        self.clearance = Some(clearance);
        clearance
    }

    pub(super) fn duration(&mut self) -> f64 {
        let usual = match self.random.index(80) {
            0 => 1e3,
            1..6 => 0.0,
            _ => 1.0 + self.random.number(),
        };
        self.duration = self.number("duration", usual);
        self.duration
    }

    pub(super) fn pieces(&mut self) -> u32 {
        // Queries of two such bodies take long.
        let usual = if self.once_in(1000) {
            3 * self.random.index(2)
        } else {
            1 + self.random.index(2)
        } as u32;
        let pieces = if self.is_odd() {
            self.random.bits()
        } else {
            usual
        };
        self.note("pieces", pieces);
        pieces
    }

    pub(super) fn joint_number(&mut self) -> usize {
        let usual = self.random.index(3);
        let number = if self.is_odd() { usize::MAX } else { usual };
        self.note("number", number);
        number
    }

    /// Draws a handle that has not been freed.
    pub(super) fn handle<T: Pooled>(&mut self) -> *mut T {
        let picked = pick::<T>(self.world, &mut self.random);
        let kind = std::any::type_name::<T>().rsplit("::").next();
        self.note(kind.unwrap_or_default(), picked.map(|(index, _)| index));
        let handle = picked.map_or(null_mut(), |(_, handle)| handle);
        self.spoil(handle).cast_mut()
    }

    /// Draws the handle of a solver or cell, and remembers it for the checks.
    pub(super) fn owner<T: Pooled>(&mut self) -> *mut T {
        let handle = self.handle::<T>();
        self.owner = handle.addr();
        handle
    }

    pub(super) fn cell_to_ask(&mut self) -> *mut RccdCell {
        let cell = self.owner();
        // A misaligned handle has no number of joints.
        self.joint_count = super::world::joint_count(cell);
        cell
    }

    pub(super) fn solver(&mut self) -> *mut RccdSolver {
        let drawn = self.owner();
        self.other_solver.unwrap_or(drawn)
    }

    /// Takes a handle from its pool, or null, to be freed.
    pub(super) fn freed<T: Pooled>(&mut self) -> *mut T {
        let picked = pick::<T>(self.world, &mut self.random);
        // A pool with few handles mostly keeps them.
        let keeps = T::pool(self.world).len() < 4 && !self.once_in(8);
        match picked {
            Some((index, _)) if !keeps => {
                self.note("handle", index);
                self.world.take(index)
            }
            _ => {
                self.note("null", ());
                null_mut()
            }
        }
    }

    /// Draws one of these texts, or a wrong one.
    pub(super) fn text_of(&mut self, name: &str, usual: &[CString]) -> *const c_char {
        let index = self.random.index(usual.len() as u32);
        let mut text = usual[index].clone();
        if self.is_odd() {
            let odd: &[u8] = match self.random.index(5) {
                0 => b"",
                1 => b"\xff\xfe not UTF-8",
                2 => "é/ß\n\"".as_bytes(),
                3 => b"no such folder/thing",
                _ => &[b'x'; 100_000],
            };
            text = CString::new(odd).unwrap();
        }
        let shown = &text.as_bytes()[..text.as_bytes().len().min(80)];
        self.note(name, String::from_utf8_lossy(shown));
        let bytes = self.keep(text.into_bytes_with_nul());
        self.spoil(bytes).cast()
    }

    pub(super) fn obstacle(&mut self) -> *const c_char {
        self.text_of("obstacle", &["ball", "box", "post"].map(c_text))
    }

    /// Draws a name of attached bodies. Such a body need not exist.
    pub(super) fn attached(&mut self) -> *const c_char {
        self.text_of("attached", &["cup", "tool"].map(c_text))
    }

    pub(super) fn link(&mut self) -> *const c_char {
        self.text_of("link", &["upper", "lower", "base"].map(c_text))
    }

    /// Draws a link that a joint moves.
    pub(super) fn moving_link(&mut self) -> *const c_char {
        self.text_of("link", &["upper", "lower"].map(c_text))
    }

    /// Draws a link, an attached body or an obstacle.
    pub(super) fn item(&mut self) -> *const c_char {
        self.text_of(
            "item",
            &["upper", "lower", "ball", "box", "cup"].map(c_text),
        )
    }

    pub(super) fn links(&mut self) -> *const *const c_char {
        let links: Vec<_> = (0..self.random.index(3)).map(|_| self.link()).collect();
        self.array("links", links, 1)
    }

    /// Returns the valid files, or the broken ones.
    fn files(&mut self) -> &'f Kinds {
        if self.is_odd() {
            &self.world.files.broken
        } else {
            &self.world.files.right
        }
    }

    pub(super) fn body_file(&mut self) -> *const c_char {
        let files = self.files();
        self.text_of("path", &files.bodies)
    }

    pub(super) fn stored_file(&mut self) -> *const c_char {
        self.text_of("path", &self.world.files.right.bodies[1..])
    }

    pub(super) fn robot_file(&mut self) -> *const c_char {
        let files = self.files();
        self.text_of("robot", &files.robots)
    }

    pub(super) fn robot_text(&mut self) -> *const c_char {
        let files = self.files();
        self.text_of("text", &files.robot_texts)
    }

    pub(super) fn srdf_file(&mut self) -> *const c_char {
        if !self.once_in(10) {
            return null();
        }
        let files = self.files();
        self.text_of("srdf", &files.srdfs)
    }

    pub(super) fn package_folder(&mut self) -> *const c_char {
        if self.once_in(2) {
            return null();
        }
        self.text_of("package_folder", &[self.world.files.folder()])
    }
}

fn c_text(text: &str) -> CString {
    CString::new(text).unwrap()
}
