// Reflectance of smooth interfaces.
#ifndef IMPORTON_LIB_FRESNEL_GLSL
#define IMPORTON_LIB_FRESNEL_GLSL

/// Unpolarised reflectance of a dielectric; cosIncident >= 0, eta = n_transmitted / n_incident; 1 at total
/// internal reflection. [Born and Wolf, 1.5.2]
float fresnelDielectric(float cosIncident, float eta) {
  const float sin2Transmitted = (1.0 - cosIncident * cosIncident) / (eta * eta);
  if (sin2Transmitted >= 1.0) return 1.0;
  const float cosTransmitted = sqrt(1.0 - sin2Transmitted);
  const float parallel = (eta * cosIncident - cosTransmitted) / (eta * cosIncident + cosTransmitted);
  const float perpendicular = (cosIncident - eta * cosTransmitted) / (cosIncident + eta * cosTransmitted);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

float pow5(float x) {
  const float x2 = x * x;
  return x2 * x2 * x;
}

/// [Schlick 1994], with the reflectance at grazing incidence of KHR_materials_specular.
vec3 fresnelSchlick(vec3 f0, float f90, float cosIncident) {
  return f0 + (vec3(f90) - f0) * pow5(clamp(1.0 - cosIncident, 0.0, 1.0));
}

#endif
