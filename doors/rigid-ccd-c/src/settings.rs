//! Settings: tolerance, margin, and limits of the work.

use crate::arguments::reference;
use crate::growing::{self, Growing};
use crate::status::{Failure, RccdStatus, status_of};
use crate::stop::RccdStop;
use rigid_ccd::{ContactNormals, Settings, StartPolicy};
use std::sync::Arc;
use std::time::Duration;

/// What to do about bodies that are in contact at the start.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdStartPolicy {
    /// The contact is the answer.
    Report = 0,
    /// The contact is ignored until the bodies approach: of motions at constant velocities, in questions about the first or any
    /// contact. In others the contact is the answer.
    Leave = 1,
}

/// How the normals and features of contacts are found.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdContactNormals {
    /// Where bodies touch up to rounding, the normal is that of the surfaces around them. To find it may take some hundred
    /// microseconds beyond a deadline, and allocates.
    Refined = 0,
    /// The normal is that of the two triangles or convex pieces, which is mostly rounding where they touch. For queries that keep
    /// a deadline or must not allocate. Questions about paths in a cell always use these.
    OfPieces = 1,
}

/// The settings of queries. Set `size`, call `rccd_settings_default`, then change what differs.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RccdSettings {
    /// The size of this struct in the caller's header; set it first.
    pub size: usize,
    /// A contact is reported at a distance of at most margin + tolerance. In the unit of length of the bodies.
    pub tolerance: f64,
    /// The distance at which bodies count as touching; 0 reports actual contact.
    pub margin: f64,
    /// The largest amount of work, in visits of about a microsecond or less. Along a trajectory it is for each part between two
    /// poses or pieces of a curve. A visit of a curve of a high degree takes longer. In a cell it is for each query of two bodies;
    /// a question about a path takes at most 8 budgets for each segment, all pairs together, and the closest approach up to half
    /// as much again.
    pub budget: u64,
    /// The time in seconds after which a query ends as unresolved, from 0 to 1e19; infinity for none.
    pub deadline: f64,
    /// One of `rccd_start_policy`.
    pub start_policy: u32,
    /// One of `rccd_contact_normals`.
    pub contact_normals: u32,
    /// A flag that stops queries, or null. Solvers share it: it may be freed.
    pub stop: *const RccdStop,
}

// SAFETY: it is `repr(C)`, begins with its size, and is of the first version.
unsafe impl Growing for RccdSettings {
    const FIRST_SIZE: usize = size_of::<RccdSettings>();
}

impl RccdSettings {
    /// Converts the settings, and shares their flag.
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

/// Fills settings, whose `size` is set, with the default ones: tolerance 0.001, margin 0, contacts at the start reported, a
/// budget of 4,194,304, no deadline.
///
/// # Safety
/// `settings` is null or points to a place of the size that its first field says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_settings_default(settings: *mut RccdSettings) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let size = unsafe { growing::size_of_place("settings", settings) }?;
        // SAFETY: the contract of this function.
        unsafe { growing::store(settings, size, &RccdSettings::default()) };
        Ok(())
    })
}
