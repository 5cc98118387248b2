#include "vessel/controller.h"

pid_gains pid_gains_for(mat3 mass, double frequency, double damping)
{
    vec3 m = plane_diagonal(mass), kp = vec3_scale(m, frequency * frequency);
    return (pid_gains){kp, vec3_scale(m, 2 * damping * frequency), vec3_scale(kp, frequency / 10)};
}

vec3 pid_step(const pid_gains *g, vec3 place, vec3 velocity, vec3 wanted, vec3 wanted_velocity, vec3 feed_forward,
              bool hold, vec3 *integral, double dt)
{
    vec3 error = vec3_sub(place, wanted);
    error.z = plane_angle(error.z);
    if (!hold)
        *integral = vec3_mad(*integral, error, dt);
    vec3 slip = vec3_sub(velocity, plane_to_vessel(place.z, wanted_velocity));
    vec3 tau = plane_times(g->proportional, plane_to_vessel(place.z, error));
    tau = vec3_add(tau, plane_times(g->derivative, slip));
    tau = vec3_add(tau, plane_times(g->integral, plane_to_vessel(place.z, *integral)));
    return vec3_sub(feed_forward, tau);
}

double vaning_step(const vaning *v, double heading, vec3 load, double dt)
{
    if (!(load.x * load.x + load.y * load.y > v->least * v->least))
        return heading;
    double left = plane_angle(real_atan2(-load.y, -load.x) - heading), most = v->rate * dt;
    return heading + fmin(fmax(left * dt / v->time, -most), most);
}
