//! Settings: tolerance, margin, and limits of work and time.

use crate::arguments::reference;
use crate::growing::{self, Growing};
use crate::status::{Failure, RccdStatus, status_of};
use crate::stop::RccdStop;
use rigid_ccd::{ContactNormals, Settings, StartPolicy};
use std::sync::Arc;
use std::time::Duration;

/// How queries treat bodies that are in contact at the start.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdStartPolicy {
    /// The contact is the answer.
    Report = 0,
    /// The contact is ignored until the bodies approach. This applies to questions about the first or any contact, of two
    /// bodies at constant velocities or on a path in a cell. In other questions about two bodies the contact is the answer.
    Leave = 1,
}

/// How the normals and features of contacts are found.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdContactNormals {
    /// If the distance at a contact is only rounding error, the normal is computed from the surfaces around the contact.
    /// This may exceed the deadline by some hundred microseconds, and allocates memory.
    Refined = 0,
    /// The normal is computed from the two triangles or convex pieces in contact. If they touch, it is mostly rounding
    /// error. Use it for queries that must keep a deadline or must not allocate. Questions about paths in a cell always
    /// use it.
    OfPieces = 1,
}

/// The settings of queries. Set `size`, call `rccd_settings_default`, then change fields.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RccdSettings {
    /// The size of this struct in the caller's header. Set it first.
    pub size: usize,
    /// The accuracy of contacts: a contact is reported at a distance of at most margin + tolerance. In the unit of
    /// length of the bodies.
    pub tolerance: f64,
    /// The distance at which bodies count as touching; 0 reports actual contact.
    pub margin: f64,
    /// The largest number of visits of a query. A visit takes about a microsecond or less, and longer for curves of a
    /// high degree. Along a trajectory the budget is for each segment between two poses, or for each polynomial of a
    /// curve. In a cell the budget is for each query of two bodies: a question about a path takes at most 8 budgets
    /// for each segment, all pairs together, and a closest approach at most 12.
    pub budget: u64,
    /// The time in seconds after which a query ends as unresolved, from 0 to 1e19. Infinity is no deadline.
    pub deadline: f64,
    /// A value of `rccd_start_policy`.
    pub start_policy: u32,
    /// A value of `rccd_contact_normals`.
    pub contact_normals: u32,
    /// A flag that stops queries, or null. Solvers share its ownership: the caller may free it at any time.
    pub stop: *const RccdStop,
}

// SAFETY: the struct is `repr(C)`, begins with its size, and has the fields of the first version.
unsafe impl Growing for RccdSettings {
    const FIRST_SIZE: usize = size_of::<RccdSettings>();
}

impl RccdSettings {
    /// Converts the settings. The result shares ownership of the flag.
    ///
    /// # Safety
    /// `stop` is null or a handle.
    pub(crate) unsafe fn to_settings(self) -> Result<Settings, Failure> {
        let start_policy = match self.start_policy {
            policy if policy == RccdStartPolicy::Report as u32 => StartPolicy::Report,
            policy if policy == RccdStartPolicy::Leave as u32 => StartPolicy::Leave,
            other => {
                let text = format!("start_policy {other} is none of rccd_start_policy");
                return Err(Failure::argument(text));
            }
        };
        let contact_normals = match self.contact_normals {
            normals if normals == RccdContactNormals::Refined as u32 => ContactNormals::Refined,
            normals if normals == RccdContactNormals::OfPieces as u32 => ContactNormals::OfPieces,
            other => {
                let text = format!("contact_normals {other} is none of rccd_contact_normals");
                return Err(Failure::argument(text));
            }
        };
        let deadline = match self.deadline {
            f64::INFINITY => None,
            seconds => Some(Duration::try_from_secs_f64(seconds).map_err(|_| {
                Failure::input(format!(
                    "deadline {seconds} is out of range: from 0 to 1e19, or infinite"
                ))
            })?),
        };
        let stop = if self.stop.is_null() {
            None
        } else {
            // SAFETY: the contract of this function.
            Some(Arc::clone(&unsafe { reference("stop", self.stop) }?.0))
        };
        let settings = Settings {
            stop,
            tolerance: self.tolerance,
            margin: self.margin,
            budget: self.budget,
            deadline,
            start_policy,
            contact_normals,
            ..Settings::DEFAULT
        };
        settings.check().map_err(Failure::input)?;
        Ok(settings)
    }
}

impl RccdSettings {
    pub(crate) fn default() -> Self {
        let Settings {
            tolerance,
            margin,
            budget,
            ..
        } = Settings::DEFAULT;
        RccdSettings {
            size: size_of::<RccdSettings>(),
            tolerance,
            margin,
            budget,
            deadline: f64::INFINITY,
            start_policy: RccdStartPolicy::Report as u32,
            contact_normals: RccdContactNormals::Refined as u32,
            stop: std::ptr::null(),
        }
    }
}

/// Fills settings with the defaults: tolerance 0.001, margin 0, contacts at the start reported, budget 4,194,304, no
/// deadline. Set `size` before.
///
/// # Safety
/// `settings` is null or points to memory of the size in its first field.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_settings_default(settings: *mut RccdSettings) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let size = unsafe { growing::caller_size("settings", settings) }?;
        // SAFETY: the contract of this function.
        unsafe { growing::store(settings, size, &RccdSettings::default()) };
        Ok(())
    })
}
