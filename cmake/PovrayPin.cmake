# The one place that says which POV-Ray is patched.
set(POVRAY_VERSION 3.7.0.10)
set(POVRAY_SHA256 7bee83d9296b98b7956eb94210cf30aa5c1bbeada8ef6b93bb52228bbc83abff)
set(POVRAY_ARCHIVE povray_${POVRAY_VERSION}.orig.tar.gz)
set(POVRAY_URL https://github.com/POV-Ray/povray/archive/v${POVRAY_VERSION}.tar.gz)
