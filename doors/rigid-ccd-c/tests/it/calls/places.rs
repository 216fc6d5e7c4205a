//! Memory for results. A failed call must leave it unchanged; results of a successful call are checked.

use super::answers::Answer;
use super::call::Call;
use super::world::{Pooled, World};
use rigid_ccd_c::*;
use std::fmt::Debug;

/// The bytes of the memory before a call.
const PATTERN: u8 = 0xa5;

/// The number of bytes behind the memory that no call may write.
const GUARD: usize = 32;

/// The arguments of a call that the checks of its results need.
pub(super) struct Context {
    pub(super) owner: usize,
    /// The number of independent joints of the cell.
    pub(super) joint_count: Option<usize>,
    /// The clearance of the question, which replaces the margin.
    pub(super) clearance: Option<f64>,
    pub(super) settings: Option<RccdSettings>,
    pub(super) duration: f64,
    pub(super) segments: usize,
}

/// Memory for a result.
pub(super) trait Place {
    /// Checks the memory after a call, and keeps handles and texts in it.
    fn check(
        &self,
        has_worked: bool,
        world: &mut World<'_>,
        context: &Context,
    ) -> Result<(), String>;

    /// Returns the bytes of an answer. They are equal for equal questions.
    fn answer(&self) -> Option<&[u8]> {
        None
    }
}

/// Memory for plain values, aligned for them, with guard bytes behind it.
pub(super) struct Bytes {
    content: Box<[u64]>,
    before: Box<[u64]>,
    length: usize,
}

impl Bytes {
    fn new<T>() -> Self {
        let length = size_of::<T>();
        let content = vec![u64::from_ne_bytes([PATTERN; 8]); (length + GUARD) / 8];
        Bytes {
            before: content.clone().into(),
            content: content.into(),
            length,
        }
    }

    fn pointer<T>(&mut self) -> *mut T {
        self.content.as_mut_ptr().cast()
    }

    /// Sets the size at the start of the memory.
    fn set_size(&mut self, size: usize) {
        self.content[0] = size as u64;
        self.before[0] = size as u64;
    }

    /// Returns the value if the call succeeded.
    fn value<T: Copy>(&self, has_worked: bool) -> Result<Option<T>, String> {
        let whole = self.length.div_ceil(8);
        if self.content[whole..] != self.before[whole..] {
            return Err("the bytes behind a place were written".to_owned());
        }
        if has_worked {
            // SAFETY: the call has written the value, as it says, and the place is aligned.
            return Ok(Some(unsafe { self.content.as_ptr().cast::<T>().read() }));
        }
        if self.content == self.before {
            Ok(None)
        } else {
            Err("a call that failed wrote to a place".to_owned())
        }
    }

    fn bytes(&self) -> &[u8] {
        // SAFETY: all bytes of the numbers are initialised.
        unsafe { std::slice::from_raw_parts(self.content.as_ptr().cast(), self.length) }
    }
}

/// Memory for a handle.
struct HandlePlace<T> {
    bytes: Bytes,
    kind: std::marker::PhantomData<*mut T>,
}

impl<T: Pooled> Place for HandlePlace<T> {
    fn check(
        &self,
        has_worked: bool,
        world: &mut World<'_>,
        context: &Context,
    ) -> Result<(), String> {
        let Some(handle) = self.bytes.value::<*mut T>(has_worked)? else {
            return Ok(());
        };
        if handle.is_null() || !handle.is_aligned() || self.bytes.content == self.bytes.before {
            return Err("a call that worked gave no handle".to_owned());
        }
        if let Some(settings) = context.settings {
            world.settings.insert(handle.addr(), settings);
        }
        if let Some(count) = context.joint_count {
            world.joint_counts.insert(handle.addr(), count);
        }
        world.add(handle);
        Ok(())
    }
}

/// Memory for a plain value, and a check of the value.
struct ValuePlace<T> {
    bytes: Bytes,
    check: fn(T, &mut World<'_>, &Context) -> Result<(), String>,
}

impl<T: Copy + Debug> Place for ValuePlace<T> {
    fn check(
        &self,
        has_worked: bool,
        world: &mut World<'_>,
        context: &Context,
    ) -> Result<(), String> {
        match self.bytes.value::<T>(has_worked)? {
            Some(value) => {
                (self.check)(value, world, context).map_err(|why| format!("{why}: {value:?}"))
            }
            None => Ok(()),
        }
    }
}

/// Memory for an answer, with the size that was set.
struct AnswerPlace<T> {
    bytes: Bytes,
    kind: std::marker::PhantomData<T>,
}

impl<T: Answer> Place for AnswerPlace<T> {
    fn check(
        &self,
        has_worked: bool,
        world: &mut World<'_>,
        context: &Context,
    ) -> Result<(), String> {
        // The two enums behind the size are read as numbers first.
        if has_worked {
            T::check_enums(self.bytes.bytes())?;
        }
        let Some(answer) = self.bytes.value::<T>(has_worked)? else {
            return Ok(());
        };
        if self.bytes.content[0] != self.bytes.before[0] {
            return Err("the size of an answer has changed".to_owned());
        }
        answer
            .check(world, context)
            .map_err(|why| format!("{why}: {answer:?}"))
    }

    fn answer(&self) -> Option<&[u8]> {
        Some(self.bytes.bytes())
    }
}

impl Call<'_, '_> {
    fn add_place<T>(
        &mut self,
        mut bytes: Bytes,
        place: impl FnOnce(Bytes) -> Box<dyn Place>,
    ) -> *mut T {
        let pointer = bytes.pointer::<T>();
        self.places.push(place(bytes));
        self.spoil(pointer).cast_mut()
    }

    pub(super) fn new_handle<T: Pooled + 'static>(&mut self) -> *mut *mut T {
        self.add_place(Bytes::new::<*mut T>(), |bytes| {
            Box::new(HandlePlace::<T> {
                bytes,
                kind: std::marker::PhantomData,
            })
        })
    }

    fn value_place<T: Copy + Debug + 'static>(
        &mut self,
        check: fn(T, &mut World<'_>, &Context) -> Result<(), String>,
    ) -> *mut T {
        self.add_place(Bytes::new::<T>(), |bytes| {
            Box::new(ValuePlace { bytes, check })
        })
    }

    pub(super) fn new_piece_count(&mut self) -> *mut usize {
        self.value_place(|count, _, _| require(count > 0, "a body has no pieces"))
    }

    pub(super) fn new_is_solid(&mut self) -> *mut i32 {
        self.value_place(|solid, _, _| require(matches!(solid, 0 | 1), "neither solid nor not"))
    }

    pub(super) fn new_excess(&mut self) -> *mut f64 {
        self.value_place(|excess, _, _| require(excess >= 0.0, "a negative excess"))
    }

    pub(super) fn new_joint_count(&mut self) -> *mut usize {
        self.value_place(|count, _, _| require(count < 10, "a robot has too many joints"))
    }

    pub(super) fn new_text(&mut self) -> *mut RccdText {
        self.value_place(|text, world, context| world.lend(context.owner, text))
    }

    /// A text that is valid until the next call for one.
    pub(super) fn new_summary(&mut self) -> *mut RccdText {
        self.value_place(|text: RccdText, _, _| {
            require(
                !text.data.is_null() && text.length > 0,
                "a summary is empty",
            )
        })
    }

    pub(super) fn new_limit(&mut self) -> *mut f64 {
        self.value_place(|limit: f64, _, _| require(!limit.is_nan(), "a limit is NaN"))
    }

    pub(super) fn new_motion(&mut self) -> *mut RccdMotion {
        self.value_place(|motion: RccdMotion, _, _| {
            let mut numbers = (motion.start.position.iter())
                .chain(&motion.start.rotation)
                .chain(&motion.velocity)
                .chain(&motion.angular_velocity)
                .chain(&motion.center);
            require(
                numbers.all(|number| number.is_finite()),
                "a motion is not finite",
            )
        })
    }

    fn answer_place<T: Answer + 'static>(&mut self) -> *mut T {
        let bytes = self.sized_place::<T>();
        self.add_place(bytes, |bytes| {
            Box::new(AnswerPlace::<T> {
                bytes,
                kind: std::marker::PhantomData,
            })
        })
    }

    /// Returns memory with its size set, which is sometimes too small.
    fn sized_place<T>(&mut self) -> Bytes {
        let mut bytes = Bytes::new::<T>();
        let right = size_of::<T>();
        let size = match self.random.index(4) {
            _ if self.is_odd() => [0, 8, right - 1][self.random.index(3)],
            0 => right + GUARD,
            _ => right,
        };
        self.note("size", size);
        bytes.set_size(size);
        bytes
    }

    pub(super) fn new_settings(&mut self) -> *mut RccdSettings {
        let bytes = self.sized_place::<RccdSettings>();
        self.add_place(bytes, |bytes| {
            Box::new(ValuePlace::<RccdSettings> {
                bytes,
                check: |settings, _, _| {
                    let is_default = settings.budget > 0 && settings.stop.is_null();
                    require(is_default, "the default settings have no budget, or a flag")
                },
            })
        })
    }

    pub(super) fn answer(&mut self) -> *mut RccdAnswer {
        self.answer_place()
    }

    pub(super) fn path_answer(&mut self) -> *mut RccdPathAnswer {
        self.answer_place()
    }
}

pub(super) fn require(holds: bool, otherwise: &str) -> Result<(), String> {
    if holds {
        Ok(())
    } else {
        Err(otherwise.to_owned())
    }
}
