//! Why there is no scenario. What is wrong with a file, where and the remedy are `dyn-platform`'s [`FileError`].

use dyn_platform::FileError;
use miette::Diagnostic;

/// Why there is no scenario.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum ScenarioError {
    /// The scenario file itself, or a measured motion.
    #[error(transparent)]
    #[diagnostic(transparent)]
    File(FileError),
    /// Its platform file.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Platform(FileError),
}
