//! The settings by name: what other languages, commands and files call them, and which questions take them.

use super::{Settings, StartPolicy};
use crate::question::Question;
use std::time::Duration;

/// A setting that callers give by its name.
///
/// ```
/// use ccd_core::{Question, Setting};
/// let names: Vec<_> = Setting::taken_by(Question::ClosestApproach).map(|setting| setting.name).collect();
/// assert_eq!(names, ["tolerance", "clearance", "budget", "deadline"]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// The name.
    pub name: &'static str,
    /// The field that has the value.
    pub field: SettingField,
    is_taken_by: fn(Question) -> bool,
}

/// The function that returns a field of [`Settings`], with a variant for each type of values.
#[derive(Clone, Copy, Debug)]
pub enum SettingField {
    /// A length, in the scene's unit.
    Length(fn(&mut Settings) -> &mut f64),
    /// A length, or none.
    OptionalLength(fn(&mut Settings) -> &mut Option<f64>),
    /// An amount of work.
    Work(fn(&mut Settings) -> &mut u64),
    /// A time on a clock, or none.
    Time(fn(&mut Settings) -> &mut Option<Duration>),
    /// What happens to bodies in contact at the start.
    StartPolicy(fn(&mut Settings) -> &mut StartPolicy),
}

impl Setting {
    /// All settings, in the order in which lists of them are shown.
    pub const ALL: [Setting; 6] = [
        Setting {
            name: "tolerance",
            field: SettingField::Length(|settings| &mut settings.tolerance),
            is_taken_by: |_| true,
        },
        Setting {
            name: "margin",
            field: SettingField::Length(|settings| &mut settings.margin),
            is_taken_by: |question| !question.is_for_a_distance(),
        },
        Setting {
            name: "clearance",
            field: SettingField::OptionalLength(|settings| &mut settings.clearance),
            is_taken_by: Question::is_for_a_distance,
        },
        Setting {
            name: "budget",
            field: SettingField::Work(|settings| &mut settings.budget),
            is_taken_by: |_| true,
        },
        Setting {
            name: "deadline",
            field: SettingField::Time(|settings| &mut settings.deadline),
            is_taken_by: |_| true,
        },
        Setting {
            name: "start",
            field: SettingField::StartPolicy(|settings| &mut settings.start_policy),
            is_taken_by: Question::has_single_contact_time,
        },
    ];

    /// Returns the setting with a name; `None` if there is none.
    pub fn from_name(name: &str) -> Option<Self> {
        let mut all = Setting::ALL.into_iter();
        all.find(|setting| setting.name == name)
    }

    /// Iterates over the settings that a question takes.
    pub fn taken_by(question: Question) -> impl Iterator<Item = Setting> {
        let all = Setting::ALL.into_iter();
        all.filter(move |setting| (setting.is_taken_by)(question))
    }
}

impl StartPolicy {
    /// Both policies.
    pub const ALL: [StartPolicy; 2] = [StartPolicy::Report, StartPolicy::Leave];

    /// Returns the name of the policy in other languages, commands and files.
    pub const fn name(self) -> &'static str {
        match self {
            StartPolicy::Report => "report",
            StartPolicy::Leave => "leave",
        }
    }

    /// Returns the policy with a name; `None` if there is none.
    pub fn from_name(name: &str) -> Option<Self> {
        let mut all = StartPolicy::ALL.into_iter();
        all.find(|policy| policy.name() == name)
    }
}

#[cfg(test)]
mod tests;
