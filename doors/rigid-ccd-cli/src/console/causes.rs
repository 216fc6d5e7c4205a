//! Formats an error with its causes: each cause once, without the operating system's error numbers.

/// Returns the messages of an error and its causes, from the outermost to the innermost.
pub(crate) fn message_with_causes(error: &anyhow::Error) -> String {
    let mut message = String::new();
    for cause in error.chain() {
        let cause = without_error_numbers(&cause.to_string());
        // Most errors repeat the message of their cause.
        if message.contains(&cause) {
            continue;
        }
        if !message.is_empty() {
            message += ": ";
        }
        message += &cause;
    }
    message
}

/// The text before the error number of the operating system.
const ERROR_NUMBER_PREFIX: &str = " (os error ";

/// Removes the operating system's error numbers from a text that already has their messages.
fn without_error_numbers(text: &str) -> String {
    let mut parts = text.split(ERROR_NUMBER_PREFIX);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part.trim_start_matches(|c: char| c.is_ascii_digit());
        match digits.strip_prefix(')') {
            Some(rest) if digits.len() < part.len() => out += rest,
            _ => {
                out += ERROR_NUMBER_PREFIX;
                out += part;
            }
        }
    }
    out
}

#[cfg(test)]
mod tests;
